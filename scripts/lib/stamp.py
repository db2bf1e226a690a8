#!/usr/bin/env python3
"""The line at the foot of a results page that says what it was made from, and which pages no longer agree with what stands.

    stamp.py line NAME [RUNS] <COMMANDS     prints the line of page NAME, made by the floe commands of standard input in folder RUNS
    stamp.py stale [--strict]               lists the stale pages; fails on faulty ones, with --strict on stale ones too

A stamp names content, no commit: a hash of the sources that the page's runs used, one of its decks, one of its script. The sources are
`include`, the CMake files, and the modules of `src` but those that the runs cannot have entered:

* `mpm`, `surface` where every run was on cells alone (`ice`); `ice` where every run was of points alone (`mpm`);
* `study`, `batch`, `plot` where the page has only single runs.

Modules that are gone (GONE) may be named by earlier stamps.

Comments and blanks do not count, neither in C nor in CMake, decks and scripts. Of the modules that a script in Python imports only the
definitions that it can reach count; what makes every page (pages.py, pages_index.py) does not. A page whose program was not built from the sources that lay there says `modified`: that is a fault.

A page of other sources is fresh all the same if its decks give the same bits under both (bits.py, scripts/same_bits.py record).
"""
import ast
import functools
import hashlib
import itertools
import os
import pathlib
import re
import subprocess
import sys

import bits

ROOT = pathlib.Path(os.environ.get("FLOE_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
SCRIPTS = "scripts/results"
GONE = ("draw", "report")  # they drew figures and pages; no file of theirs is left
LIBRARIES = ("python", "scripts/lib", SCRIPTS)
STAMP = re.compile(r"^\*Made from sources (?P<sources>[0-9a-f]{16})(?P<modified>-modified)?(?: without (?P<without>[a-z ]+))?"
                   r"(?:, also (?P<also>[\w/. ]+))?; decks (?P<decks>[0-9a-f]{16})(?: of (?P<names>[^;]+))?; script (?P<script>[0-9a-f]{16})\.\*$")
C_TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'', re.DOTALL)


class Tree:
    """Files by their path from the root: as they lie there, or as a commit has them."""

    def __init__(self, commit=None):
        self.commit = commit

    def files(self, *folders):
        if self.commit:
            text = git("ls-tree", "-r", "--name-only", self.commit, "--", *folders)
            return sorted(text.splitlines())
        found = []
        for folder in folders:
            path = ROOT / folder
            found += [path] if path.is_file() else [one for one in path.rglob("*") if one.is_file()]
        return sorted(str(one.relative_to(ROOT)) for one in found if "__pycache__" not in one.parts)

    def text(self, path):
        return git("show", f"{self.commit}:{path}") if self.commit else (ROOT / path).read_text(encoding="utf-8", errors="replace")

    def has(self, path):
        return bool(self.files(path)) if self.commit else (ROOT / path).is_file()


def git(*words):
    return subprocess.run(("git", "-C", str(ROOT)) + words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True).stdout.decode(errors="replace")


# ---- what counts of a text ----

def bare_c(text):
    """C without comments; blanks as one; the lines of the preprocessor, where they mean something, stay lines."""
    text = C_TOKEN.sub(lambda found: " " if found.group().startswith("/") else found.group(), text).replace("\\\n", " ")
    lines = [" ".join(line.split()) for line in text.splitlines()]
    return "\n".join(join_lines(lines))


def join_lines(lines):
    """Lines of C joined but for those of the preprocessor."""
    out, run = [], []
    for line in lines:
        if line.startswith("#"):
            out += [" ".join(run), line]
            run = []
        elif line:
            run.append(line)
    return [line for line in out + [" ".join(run)] if line]


def bare_lines(text):
    """YAML and CMake without lines of comment, and without what follows a # behind a blank where no quote is near."""
    lines = (line if re.search("[\"']", line) else re.sub(r"\s#.*", "", line) for line in text.splitlines())
    return "\n".join(line.rstrip() for line in lines if line.strip() and not line.lstrip().startswith("#"))


@functools.cache
def bare(path, text):
    if path.endswith((".c", ".h", ".in")):
        return bare_c(text)
    return bare_lines(text)


def digest(parts):
    """Of pairs of a name and a text."""
    sum_of = hashlib.sha256()
    for name, text in parts:
        sum_of.update(f"{name}\0{len(text)}\0{text}\0".encode())
    return sum_of.hexdigest()[:16]


# ---- sources ----

def modules(tree):
    return sorted({path.split("/")[1] for path in tree.files("src") if path.count("/") > 1})


def left_out(tree, couplings, commands, text):
    """The modules that runs of these couplings, by these commands, do not enter; `text`: of decks and commands. Nothing is known: none."""
    out = set()
    if couplings == {"ice"}:
        out |= {"mpm", "surface"}
    if couplings == {"mpm"}:
        out |= {"ice"}
    if couplings and commands:
        if commands <= {"run", "picture"} and "tolerance" not in text:
            out |= {"study", "batch", "plot"}
    return out & set(modules(tree))


def sources_hash(tree, without, also=(), text_of=None):
    """`text_of(path)`: what counts of a file, where that is known already."""
    files = tree.files("src", "include", "cmake", "CMakeLists.txt", "CMakePresets.json", *also)
    kept = [path for path in files if not any(path.startswith(f"src/{module}/") for module in without)]
    return digest((path, text_of(path) if text_of else bare(path, tree.text(path))) for path in kept)


def name_of(without, also):
    """By which a record has the hash of the sources of a page that leaves out modules and hangs on other files."""
    return " ".join(without) + (f"; {' '.join(also)}" if also else "")


def sources_names(tree, others):
    """The hash of the sources by the modules that a page may leave out, as its stamp has them (left_out), and by the files of `others` that it hangs on besides."""
    text_of = functools.cache(lambda path: bare(path, tree.text(path)))
    names = {}
    for entered in itertools.product(((), ("mpm", "surface"), ("ice",)), ((), ("report",)), ((), ("draw",)), ((), ("study", "batch"), ("study", "batch", "plot"))):
        without = sorted(set(itertools.chain(*entered)) & {*modules(tree), *GONE})
        for also in ((), *others):
            names.setdefault(name_of(without, also), sources_hash(tree, without, also, text_of))
    return names


def built_from(version, without, also):
    """Whether a program of that version is what the sources make that lie here."""
    found = re.search(r"\(([0-9a-f]{7,40})(-modified)?\)", version)
    if not found:
        return False
    places = ("src", "include", "cmake", "CMakeLists.txt", "CMakePresets.json") + tuple(also)
    try:
        if found.group(2) and git("status", "--porcelain", "--", *places).strip():
            return False
        changed = git("diff", "--name-only", found.group(1), "--", *places).split()
        return not changed or sources_hash(Tree(found.group(1)), without, also) == sources_hash(Tree(), without, also)
    except subprocess.CalledProcessError:
        return False


# ---- decks ----

def decks_of(commands):
    """The decks that commands name; a name in capitals stands for any."""
    found = set()
    for word in re.findall(r"inputs/[\w./*-]+\.yaml", commands):
        pattern = re.sub(r"[A-Z]{2,}", "*", word)
        found |= {str(path.relative_to(ROOT)) for path in ROOT.glob(pattern)}
    return sorted(found)


def decks_hash(tree, names):
    parts = []
    for name in names:
        if not tree.has(name):
            parts.append((name, "gone"))
            continue
        text = bare_lines(tree.text(name))
        parts.append((name, text))
        for word in sorted(set(re.findall(r"[\w./-]+\.(?:csv|txt|h5|yaml)\b", text))):
            path = os.path.normpath(os.path.join(os.path.dirname(name), word))
            if tree.has(path):
                parts.append((path, tree.text(path)))
    return digest(parts)


def file_hash(tree, name):
    return digest([(name, bare(name, tree.text(name)))])


def brief(names):
    """Names of decks in few words: a whole folder of them by its pattern."""
    out = []
    for folder in sorted({os.path.dirname(name) for name in names}):
        own = [name for name in names if os.path.dirname(name) == folder]
        everything = sorted(str(path.relative_to(ROOT)) for path in (ROOT / folder).glob("*.yaml"))
        out += [folder + "/*.yaml"] if own == everything and len(own) > 3 else own
    return " ".join(out)


# ---- scripts ----

def script_of(name):
    """The script that makes a page; None: there is none."""
    path = f"{SCRIPTS}/{name}.py"
    return path if (ROOT / path).is_file() else None


def without_docstrings(tree):
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(body, list) and body and isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant) \
                and isinstance(body[0].value.value, str):
            node.body = body[1:] or [ast.Pass()]
    return tree


def identifiers(node):
    found = set()
    for one in ast.walk(node):
        if isinstance(one, ast.Name):
            found.add(one.id)
        elif isinstance(one, ast.Attribute):
            found.add(one.attr)
        elif isinstance(one, ast.alias):
            found |= set(one.name.split("."))
    return found


def definitions(path, text):
    """Pieces of a module as (names that call it, node): a function, a method, the rest of a class, any other statement."""
    for node in without_docstrings(ast.parse(text)).body:
        if isinstance(node, ast.ClassDef):
            methods = [one for one in node.body if isinstance(one, ast.FunctionDef) and not one.name.startswith("__")]
            for method in methods:
                yield {method.name}, method, f"{path}:{node.name}.{method.name}"
            node.body = [one for one in node.body if one not in methods] or [ast.Pass()]
            yield {node.name}, node, f"{path}:{node.name}"
        elif isinstance(node, ast.FunctionDef):
            yield {node.name}, node, f"{path}:{node.name}"
        elif not isinstance(node, (ast.Import, ast.ImportFrom)):
            names = {one.id for one in ast.walk(node) if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store)}
            yield names, node, f"{path}:{' '.join(sorted(names))}"


def imported(tree, path):
    """Modules of ours that a module imports, as paths."""
    for node in ast.walk(tree):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.level:
            base = os.path.dirname(path)
            for word in [node.module] if node.module else [alias.name for alias in node.names]:
                candidate = f"{base}/{word.replace('.', '/')}.py"
                if (ROOT / candidate).is_file():
                    yield candidate
        elif isinstance(node, ast.ImportFrom):
            names = [node.module] + [f"{node.module}.{alias.name}" for alias in node.names]
        for name in names:
            for library in LIBRARIES + (os.path.dirname(path),):
                stem = f"{library}/{name.replace('.', '/')}"
                for candidate in (stem + ".py", stem + "/__init__.py"):
                    if (ROOT / candidate).is_file():
                        yield candidate


@functools.cache
def pieces_of(module):
    """Its pieces, and which modules of ours it imports."""
    source = (ROOT / module).read_text(encoding="utf-8")
    return list(definitions(module, source)), list(imported(ast.parse(source), module))


def python_parts(path):
    """All of the script, and of what it imports the pieces that its names reach."""
    text = (ROOT / path).read_text(encoding="utf-8")
    tree = without_docstrings(ast.parse(text))
    reached, parts = identifiers(tree), [(path, ast.unparse(tree))]
    modules, waiting = {}, list(imported(tree, path))
    while waiting:
        module = waiting.pop()
        if module in modules or module == path:
            continue
        modules[module], further = pieces_of(module)
        waiting += further
    left = [piece for pieces in modules.values() for piece in pieces]
    grown = True
    while grown:
        grown = False
        for piece in list(left):
            names, node, label = piece
            if names & reached:
                reached |= identifiers(node)
                parts.append((label, ast.unparse(node)))
                left.remove(piece)
                grown = True
    return sorted(parts)


def script_hash(name):
    return digest(python_parts(script_of(name)))


# ---- a page's line ----

def line(name, couplings, commands, version, also=()):
    """The stamp of a page of these couplings and these commands, with what else of the tree it was made from."""
    tree = Tree()
    decks = decks_of(commands) or decks_of("inputs/*.yaml")
    text = commands + "".join(tree.text(deck) for deck in decks)
    words = set(re.findall(r"^ *floe (\w+)", commands, re.MULTILINE))
    without = sorted(left_out(tree, set(couplings), words, text))
    modified = "" if built_from(version, without, also) else "-modified"
    parts = [f"sources {sources_hash(tree, without, also)}{modified}"]
    parts[0] += f" without {' '.join(without)}" if without else ""
    parts[0] += f", also {' '.join(also)}" if also else ""
    parts += [f"decks {decks_hash(tree, decks)} of {brief(decks)}", f"script {script_hash(name)}"]
    return f"*Made from {'; '.join(parts)}.*"


def couplings_under(folder):
    """The couplings of all runs in a folder, by their summaries."""
    found = set()
    for path in pathlib.Path(folder).rglob("summary.json"):
        found |= set(re.findall(r'^ *"coupling": "([a-z-]+)"', path.read_text(encoding="utf-8", errors="replace"), re.MULTILINE))
    return found


# ---- which pages are stale ----

def faults_of(name, stamp, is_listed):
    """What no page may be; None: nothing."""
    if not script_of(name) and not is_listed:
        return "no command makes it"
    if not stamp:
        return None if is_listed else "no stamp, or none that can be read"
    if is_listed:
        return "has a stamp: take it off scripts/results/unstamped.txt"
    return "made by a program of other sources than it names" if stamp["modified"] else None


def commands_in(text):
    """The commands of a page: what is under its last heading How."""
    return text.rpartition("\n## How\n")[2]


def why_other_sources(tree, stamp, text, records):
    """Why a page is not as good as made from the sources that lie here, from other ones; None: it is."""
    without, also = (stamp["without"] or "").split(), (stamp["also"] or "").split()
    now = sources_hash(tree, without, also)
    if now == stamp["sources"]:
        return None
    named = {name: [one for one in records if one.names.get(name_of(without, also)) == name] for name in (stamp["sources"], now)}
    if not all(named.values()):
        return f"sources, no record of bits of those {'that it names' if not named[stamp['sources']] else 'that lie here'}"
    decks = {name: tree.text(name) for name in decks_of(stamp["names"] or "")}
    texts = [tree.text(name) for name in sorted({key[1] for one in records for key in one.rows}) if tree.has(name)]
    deck_hash = functools.cache(lambda name: decks_hash(tree, [name]) if name.endswith(".yaml") else file_hash(tree, name))
    found = [bits.differences(before, after, commands_in(text), decks, also, deck_hash, texts)
             for before in named[stamp["sources"]] for after in named[now]]
    least = min(found, key=len)
    return f"sources: {'; '.join(least[:3])}{f'; and {len(least) - 3} more' if len(least) > 3 else ''}" if least else None


def changes_of(name, stamp, text, records):
    """Which of sources, decks and script are not what the stamp says, nor of the same effect."""
    tree, out = Tree(), []
    why = why_other_sources(tree, stamp, text, records)
    if why:
        out.append(why)
    if decks_hash(tree, decks_of(stamp["names"] or "")) != stamp["decks"]:
        out.append("decks")
    if not script_of(name) or script_hash(name) != stamp["script"]:
        out.append("script")
    return out


def stamp_in(text):
    lines = [one for one in text.splitlines() if one.strip()]
    found = STAMP.match(lines[-1]) if lines else None
    return found.groupdict() if found else None


def list_stale(strict, folder):
    listed = set(bare_lines((ROOT / SCRIPTS / "unstamped.txt").read_text(encoding="utf-8")).split())
    faults, stale = [], [(name, "no stamp") for name in sorted(listed)]
    records = list(bits.read(ROOT / bits.FOLDER).values())
    pages = {path.stem: path.read_text(encoding="utf-8") for path in sorted(pathlib.Path(folder).glob("*.md")) if path.stem != "README"}
    faults += [(name, "on scripts/results/unstamped.txt, and there is no such page") for name in sorted(listed - set(pages))]
    for name, text in pages.items():
        stamp = stamp_in(text)
        fault = faults_of(name, stamp, name in listed)
        if fault:
            faults.append((name, fault))
        elif stamp and (changes := changes_of(name, stamp, text, records)):
            stale.append((name, "other " + ", ".join(changes)))
    for kind, found in (("stale", sorted(stale)), ("faulty", faults)):
        for name, why in found:
            print(f"{kind}: {name}: {why}")
    print(f"{len(pages)} pages: {len(pages) - len(stale) - len(faults)} fresh, {len(stale)} stale, {len(faults)} faulty")
    return 1 if faults or (strict and stale) else 0


def main():
    if sys.argv[1:2] == ["line"]:
        name, runs = sys.argv[2], sys.argv[3] if len(sys.argv) > 3 else os.devnull
        version = subprocess.run([os.environ.get("FLOE", str(ROOT / "build/release/floe")), "--version"], stdout=subprocess.PIPE, check=True)
        print(line(name, couplings_under(runs), sys.stdin.read(), version.stdout.decode(), tuple(sys.argv[4:])))
        return 0
    if sys.argv[1:2] == ["stale"]:
        return list_stale("--strict" in sys.argv, os.environ.get("FLOE_PAGES", ROOT / "docs/results"))
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
