"""Which mutants there are: drawn from all sites by a seed, module by module, without those that are proved equivalent or do not compile."""
import json
import os
import subprocess
import tempfile

from mutation.sites import sites_of
from mutation.tree import Tree, mutated_text, once

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(HERE)))
DRAWN = ("mpm", "ice", "coupling", "study")
# Which modules each share is drawn from: cells that surfaces cut were a part of the coupling, and are drawn with it.
MODULES = {"embedded": "coupling", **{module: module for module in DRAWN}}


def module_of(path):
    """The share that a source belongs to; None: to none."""
    part = path.split("/")
    return MODULES.get(part[1]) if part[0] == "src" and len(part) > 2 else None


def names_of_sources():
    told = subprocess.run(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True, check=True).stdout
    return sorted(n for n in told.splitlines() if os.path.isfile(os.path.join(ROOT, n)))


def entries(name):
    """A file of `key` lines, each with its reason below it, indented."""
    found, key = {}, None
    with open(os.path.join(HERE, name)) as f:
        for line in f:
            if line.startswith("#") or not line.strip():
                continue
            if line[0] != " ":
                key = line.rstrip("\n")
                found[key] = ""
            else:
                found[key] = (found[key] + " " + line.strip()).strip()
    return found


def read(name):
    with open(os.path.join(ROOT, name), encoding="utf-8") as f:
        return f.read()


class Draw:
    """The mutants of a seed, module by module in turn, and how many sites there are."""

    def __init__(self, names, seed, count, excluded):
        self.texts, self.total, self.excluded_used = {}, {}, []
        by_module = {}
        for module in DRAWN:
            sites = []
            for name in names:
                if module_of(name) == module and name.endswith((".c", ".h")):
                    self.texts[name] = read(name)
                    sites += sites_of(name, self.texts[name], seed)
            self.total[module] = len(sites)
            by_module[module] = sorted(sites, key=lambda s: s.rank(seed))
        self.sites = []
        for k in range(max(len(s) for s in by_module.values())):
            for module in DRAWN:
                if k < len(by_module[module]):
                    self.sites.append(by_module[module][k])
        self.count, self.excluded = count, excluded

    def choose(self, compiles, numbers, run):
        """The first of each module that are not excluded and compile, `count` together. `numbers` keeps the number that each has in the builds,
        so that a change of the sources elsewhere leaves their texts as they are."""
        share = {module: self.count // len(DRAWN) for module in DRAWN}
        chosen = []
        for s in self.sites:
            module = module_of(s.path)
            if share[module] == 0:
                continue
            s.reached = False
            if s.key() in self.excluded and s.key() not in run:  # one that was proved after its run stays in the draw
                self.excluded_used.append(s.key())
                continue
            if not compiles(s):
                continue
            share[module] -= 1
            chosen.append(s)
            s.order = len(chosen)
            s.number = numbers.setdefault(s.key(), len(numbers) + 1)
        return chosen


class Compiler:
    """Whether a mutated text compiles, by the command of its file (a header's: of any file of its module)."""

    def __init__(self, tree):
        self.tree = tree
        with open(os.path.join(tree.build, "compile_commands.json")) as f:
            self.command = {os.path.relpath(os.path.realpath(e["file"]), os.path.realpath(tree.folder)): e for e in json.load(f)}

    def good(self, name, text):
        entry = self.command.get(name)
        if entry is None:
            module = "/".join(name.split("/")[:2])
            entry = next(e for n, e in sorted(self.command.items()) if n.startswith(module + "/"))
        words = [w for w in entry["command"].split() if not w.endswith("ccache")]
        words = words[:words.index("-o")] + ["-w", "-mavx2", "-fsyntax-only", "-x", "c"]
        folder = os.path.dirname(self.tree.path(name))
        with tempfile.NamedTemporaryFile("w", suffix=".c", dir=folder) as f:
            f.write(text)
            f.flush()
            return subprocess.run(words + [f.name], cwd=entry["directory"], capture_output=True).returncode == 0


def forms_of(draw, compiler, cache):
    """A function that says whether a mutant compiles, and sets how it is put in: by a switch, or by rebuilding its file."""
    def compiles(s):
        text, header, key = draw.texts[s.path], s.path.endswith(".h"), s.key()
        if key not in cache:
            s.number = 1
            known = {"switch": not s.rebuild and compiler.good(s.path, mutated_text(text, [s], "switch", header))}
            known["note"] = known["switch"] and compiler.good(s.path, mutated_text(text, [s], "note", header))
            known["once"] = known["switch"] or compiler.good(s.path, once(text, s))
            cache[key] = known
        known = cache[key]
        s.rebuild, s.reached = not known["switch"], not known["note"]
        return known["once"]
    return compiles


def plan(seed, count, folder, state):
    names = names_of_sources()
    draw = Draw(names, seed, count, entries("equivalent.txt"))
    trees = {style: Tree(ROOT, folder, style) for style in ("switch", "note")}
    if not os.path.exists(os.path.join(trees["switch"].build, "compile_commands.json")):
        trees["switch"].copy(names, {})
        trees["switch"].configure()
    mutants = draw.choose(forms_of(draw, Compiler(trees["switch"]), state.data["compiles"]), state.data["numbers"], state.data["mutants"])
    state.save()
    return names, draw, mutants, trees
