"""Tests under limits, which of them could see a mutant, and which does."""
import collections
import hashlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import tempfile

from mutation.draw import ROOT, read
from mutation.tree import cpu_of_children, mutated_text, once

# They look at the sources, or compile the kernels twice more; what they see of a mutant is that it is there.
LEFT_OUT = {"source_rules", "cli_widths", "cli_install"}


class Runner:
    """Runs tests of a tree under limits: processor time, memory, sizes of files, and time on the wall."""

    def __init__(self, tree):
        self.tree, self.tests = tree, {k: v for k, v in tree.tests().items() if k not in LEFT_OUT}

    def run(self, name, extra, cpu_limit=None):
        """(what went wrong or "", CPU seconds)."""
        argv, environment, folder = self.tests[name]
        scratch = tempfile.mkdtemp(prefix="mutant")
        cpu = int(cpu_limit + 1) if cpu_limit else 600

        def limits():
            os.setsid()
            resource.setrlimit(resource.RLIMIT_CPU, (cpu, cpu + 1))
            resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 28, 1 << 28))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            if cpu_limit:
                resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))

        before = cpu_of_children()
        process = subprocess.Popen(argv, cwd=folder, env={**os.environ, **environment, "TMPDIR": scratch, **extra}, preexec_fn=limits,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        try:
            told = process.communicate(timeout=30 + 20 * cpu)[0].decode(errors="replace")
            wrong = "" if process.returncode == 0 else said(told, process.returncode)
        except subprocess.TimeoutExpired:
            wrong = "does not end"
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()
        shutil.rmtree(scratch, ignore_errors=True)
        return wrong, cpu_of_children() - before


def said(told, status):
    lines = [line.strip() for line in told.splitlines() if re.search(r"ERROR|FAIL|not |fail", line)]
    return (lines[0] if lines else "ends")[:160] + f" (status {status})"


class State:
    """What is known of mutants and tests; written after each, so that a run goes on where it was stopped."""

    def __init__(self, folder):
        self.path = os.path.join(folder, "state.json")
        self.data = {"mutants": {}, "tests": {}, "compiles": {}, "numbers": {}, "cpu": {"build": 0.0, "look": 0.0, "run": 0.0}}
        if os.path.exists(self.path):
            with open(self.path) as f:
                self.data.update(json.load(f))

    def save(self):
        with open(self.path + ".new", "w") as f:
            json.dump(self.data, f, indent=1)
        os.replace(self.path + ".new", self.path)

    def add_cpu(self, what, before):
        self.data["cpu"][what] += cpu_of_children() - before


def source_hash(names):
    h = hashlib.sha256()
    for n in names:
        if n.startswith(("src/", "tests/", "inputs/")):
            h.update(n.encode() + b"\0" + open(os.path.join(ROOT, n), "rb").read())
    return h.hexdigest()[:12]


def build(names, draw, mutants, trees, state):
    """The trees that are asked for: what no look is taken with need not be built."""
    before = cpu_of_children()
    for style, tree in trees.items():
        mutated = {}
        for path in {s.path for s in mutants if not s.rebuild}:
            edits = [s for s in mutants if s.path == path and not s.rebuild]
            mutated[path] = mutated_text(draw.texts[path], edits, style, path.endswith(".h"))
        tree.copy(names, mutated)
        tree.configure()
        tree.make()
        print(f"built  {style}: {cpu_of_children() - before:.0f} s of CPU so far", flush=True)
    state.data["built"] = source_hash(names)
    state.add_cpu("build", before)
    state.save()


def costs_of_tests():
    """Seconds by name, of the last ctest of the release build, if there was one."""
    costs, path = {}, os.path.join(ROOT, "build/release/Testing/Temporary/CTestCostData.txt")
    if os.path.exists(path):
        with open(path) as f:
            for words in (line.split() for line in f):
                if len(words) == 3 and float(words[2]) > 0.0:
                    costs[words[0]] = float(words[2])
    return costs


def look(state, tree, mutants, longest):
    """Which tests see which mutants' values differ: each test once in the tree that notes, and again when its text has changed. A mutant that came
    later is asked of all tests."""
    runner = Runner(tree)
    tests = state.data["tests"]
    for name in list(tests):
        if name not in runner.tests:
            del tests[name]
    keys = [s.key() for s in mutants]
    costs = costs_of_tests()
    for name in sorted(runner.tests, key=lambda n: (costs.get(n, 2.0), n)):
        known = tests.get(name)
        mark = test_mark(runner.tests[name][0])
        same = known is not None and known["mark"] == mark
        if costs.get(name, 2.0) > longest or same and set(keys) <= set(known["asked"]):
            continue
        seen = os.path.join(os.path.dirname(state.path), "seen")
        if os.path.exists(seen):
            os.remove(seen)
        before = cpu_of_children()
        wrong, cpu = runner.run(name, {"FLOE_SEEN": seen})
        state.add_cpu("look", before)
        bits = open(seen, "rb").read() if os.path.exists(seen) else b""
        seen = [s.key() for s in mutants if s.number < len(bits) and bits[s.number]]
        asked_before = [k for k in known["asked"] if k not in keys] if same else []  # of other draws
        tests[name] = {"mark": mark, "cpu": cpu, "wrong": wrong, "asked": keys + asked_before,
                       "seen": seen + [k for k in asked_before if k in known["seen"]]}
        print(f"look   {name}: {cpu:.1f} s, {len(seen)} of {len(keys)}{'; FAILS ' + wrong if wrong else ''}", flush=True)
        state.save()


def test_mark(argv):
    """What a test's own text is: a script's bytes, a program's source's."""
    path = argv[-1]
    if not path.endswith(".sh"):
        kind, rest = os.path.basename(path).split("_", 1) if "_" in os.path.basename(path) else ("", "")
        path = os.path.join(ROOT, "tests", kind, f"test_{rest}.c")
    else:
        path = os.path.join(ROOT, "tests", "cli", os.path.basename(path))
    return hashlib.sha256(open(path, "rb").read()).hexdigest()[:12] if os.path.exists(path) else ""


# What tests of a part are called that is not in the names of its files.
ALSO = {"balance": {"statics", "rest"}, "edge": {"edges"}, "normal": {"normals"}, "boundary": {"sides"}, "open": {"sides"}, "reaction": {"react"},
        "heat": {"diffusion"}, "traction": {"force"}, "cut": {"sharp"}, "choose": {"tolerance"}, "wall": {"side"},
        "coupling": {"coupled"}, "strip": {"transfer"}, "cell": {"transfer"}, "trace": {"exchange"}, "dispersed": {"exchange", "law"},
        "equilibrium": {"exchange"}, "implicit": {"statics", "rest"}, "loads": {"force"}, "seed": {"sort"}, "scatter": {"kernel", "bits"},
        "gather": {"kernel", "bits"}, "project": {"kernel", "bits"}, "stencil": {"basis", "bits"}, "merged": {"embedded"}, "json": {"bars"},
        "write": {"bars"}, "profile": {"compare", "report"}, "figure": {"compare"}, "miss": {"bars", "check"}, "front": {"values"}}


def words_of(path):
    words = set(re.findall(r"[a-z]+", path.removeprefix("src/"))) - {"c", "h"}
    return words.union(*(ALSO.get(w, set()) for w in words))


def killers_of_file(state, path):
    """How many mutants of a file each test has killed."""
    known = state.data["mutants"].items()
    return collections.Counter(m["by"] for key, m in known if m["status"] == "killed" and key.startswith(path + "|"))


def candidates(state, runner, site, killer, longest):
    """The tests that could see it: those of its own part and those that have killed others of its file first, then the cheapest; one that has killed
    it before goes first. Asked are those in which its value has differed; of a rebuilt file, and of what no look has been taken at, those of its own
    part at least."""
    tests, words, costs, killers = state.data["tests"], words_of(site.path), costs_of_tests(), killers_of_file(state, site.path)
    for name in runner.tests:
        tests.setdefault(name, {"mark": "", "cpu": costs.get(name, 5.0), "wrong": "", "asked": [], "seen": []})
    score = {}
    for name, t in tests.items():
        own = len(words & set(name.split("_"))) + min(killers[name], 2)
        looked = t["mark"] == test_mark(runner.tests[name][0]) and site.key() in t["asked"] if name in runner.tests else False
        if t["wrong"] or t["cpu"] > 2.0 * longest or name not in runner.tests:
            continue
        if site.rebuild or site.key() in t["seen"] or (own and not looked):
            score[name] = (name != killer, t["cpu"] * 0.2**own)
    return sorted(score, key=score.get)


def marks_of_draw(state, runner, seed):
    """The texts of the tests that there were when a draw was first run: what they see, nobody wrote for it."""
    marks = state.data.setdefault("marks", {})
    return marks.setdefault(str(seed), {name: test_mark(argv) for name, (argv, _, _) in runner.tests.items()})


def try_mutant(state, runner, site, commit, marks, longest, most):
    known = state.data["mutants"].get(site.key(), {})
    before, tests = cpu_of_children(), candidates(state, runner, site, known.get("by"), longest)
    result = {"status": "survived", "by": "", "said": "", "ran": 0, "commit": commit}
    if site.rebuild:
        path = runner.tree.path(site.path)
        with open(path) as f:
            kept = f.read()
        runner.tree.put(site.path, once(read(site.path), site).encode())
        runner.tree.make()
    passed = dict(known.get("passed", {}))
    for name in tests:
        test = state.data["tests"][name]
        mark = test_mark(runner.tests[name][0])
        result["ran"] += 1
        if passed.get(name) == mark:
            continue
        if len(passed) - len(known.get("passed", {})) >= most:
            result["left"] = True
            break
        wrong, _ = runner.run(name, {"FLOE_MUTANT": "0" if site.rebuild else str(site.number)}, 3.0 * test["cpu"] + 2.0)
        if wrong and fails_alone(state, runner, name):
            continue
        if wrong:
            result.update(status="killed", by=name, said=wrong)
            break
        passed[name] = mark
    result["passed"] = passed
    killer = result["by"]
    result["unlooked"] = bool(killer) and test_mark(runner.tests[killer][0]) == marks.get(killer)
    if site.rebuild:
        runner.tree.put(site.path, kept.encode())
        runner.tree.make()
    result["cpu"] = cpu_of_children() - before
    state.data["mutants"][site.key()] = result
    state.add_cpu("run", before)
    state.save()
    return result


def fails_alone(state, runner, name):
    """Whether a test fails in the tree of switches with none in force; asked of each that has failed with one."""
    t, mark = state.data["tests"][name], test_mark(runner.tests[name][0])
    if t.get("checked") != mark:
        t["wrong"], t["cpu"] = runner.run(name, {"FLOE_MUTANT": "0"})
        t["checked"] = mark
        if t["wrong"]:
            print(f"left out: {name} fails without a mutant: {t['wrong']}", flush=True)
        state.save()
    return bool(t["wrong"])


