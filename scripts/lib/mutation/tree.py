"""Copies of the sources that hold mutants, and their builds. The sources of floe themselves know nothing of it.

`switch`: every mutant is in, and FLOE_MUTANT=N in the environment puts number N into force: (floe_mutant == N ? changed : as it is).
`note`: none is in force; each site notes in the file FLOE_SEEN whether its mutant's value ever differs from its own."""
import json
import os
import resource
import subprocess

from mutation.sites import changed_text

SWITCH_C = """#include <stdlib.h>
extern int floe_mutant;
int floe_mutant;
__attribute__((constructor)) static void choose_mutant(void)
{
    const char *number = getenv("FLOE_MUTANT");
    floe_mutant = number ? atoi(number) : 0;
}
"""
NOTE_C = """#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>
extern unsigned char *floe_seen;
static unsigned char unread[4096];
unsigned char *floe_seen = unread;
__attribute__((constructor)) static void open_seen(void)
{
    const char *name = getenv("FLOE_SEEN");
    const int file = name ? open(name, O_RDWR | O_CREAT, 0600) : -1;
    if (file < 0 || ftruncate(file, sizeof unread) != 0) return;
    void *shared = mmap(NULL, sizeof unread, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (shared != MAP_FAILED) floe_seen = shared;
    close(file);
}
"""
DECLARED = {"switch": "extern int floe_mutant;\n", "note": "extern unsigned char *floe_seen;\n"}
# Beyond an array of known size a run ends, as the nightly tests with sanitizers do.
OPTIONS = {"switch": ("-w", "-fsanitize=bounds", "-fsanitize-undefined-trap-on-error"), "note": ("-w",)}
EFFECTS = ("++", "--", "=", "+=", "-=", "*=", "/=", "&&", "||")


def cpu_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Tree:
    def __init__(self, root, folder, style):
        self.root, self.style = root, style
        self.folder = os.path.join(folder, style)
        self.build = os.path.join(self.folder, "build", "release")

    def path(self, name):
        return os.path.join(self.folder, name)

    def put(self, name, data):
        """Writes a file of the copy, unless it holds that already (its time is what ninja goes by)."""
        path = self.path(name)
        if os.path.exists(path):
            with open(path, "rb") as f:
                if f.read() == data:
                    return
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as f:
            f.write(data)

    def copy(self, names, mutated):
        """The sources by name, those in `mutated` with its text; what is no longer in the sources goes."""
        for name in names:
            if name not in mutated:
                with open(os.path.join(self.root, name), "rb") as f:
                    data = f.read()
                parts = name.split("/")
                if len(parts) == 3 and parts[0] == "src" and parts[2] == "CMakeLists.txt" and parts[1] in ("mpm", "ice", "coupling", "embedded", "study"):
                    data = f"add_compile_options({' '.join(OPTIONS[self.style])})\n".encode() + data
                self.put(name, data)
                mode = os.stat(os.path.join(self.root, name)).st_mode
                os.chmod(self.path(name), mode & 0o777)
        for name, text in mutated.items():
            self.put(name, text.encode())
        self.put("src/base/mutant.c", (SWITCH_C if self.style == "switch" else NOTE_C).encode())
        known = set(names) | {"src/base/mutant.c"}
        for top in ("src", "tests", "inputs"):
            for folder, _, files in os.walk(self.path(top)):
                for file in files:
                    path = os.path.join(folder, file)
                    if os.path.relpath(path, self.folder) not in known:
                        os.remove(path)

    def configure(self):
        if not os.path.exists(os.path.join(self.build, "build.ninja")):
            self.command(["cmake", "--preset", "release"], self.folder)

    def make(self):
        """All tests and the program, but not what compares instruction sets (it compiles the kernels twice more)."""
        self.command(["ninja", "-C", self.build, "build.ninja"], self.folder)
        told = subprocess.run(["ninja", "-C", self.build, "-t", "targets", "all"], capture_output=True, text=True, check=True).stdout
        targets = [line.split(":")[0] for line in told.splitlines() if "_LINKER__" in line]
        wanted = [t for t in targets if t == "floe" or t.startswith("tests/") and "floe_x86" not in t and not t.endswith(".a")]
        self.command(["ninja", "-j1", "-C", self.build] + wanted, self.folder)

    def command(self, argv, folder):
        done = subprocess.run(argv, cwd=folder, capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"{' '.join(argv[:6])}\n{done.stdout[-6000:]}{done.stderr[-2000:]}")

    def tests(self):
        """The quick tests: name -> (argv, environment, folder)."""
        told = subprocess.run(["ctest", "--test-dir", self.build, "-L", "quick", "--show-only=json-v1"], capture_output=True, text=True,
                              check=True).stdout
        tests = {}
        for t in json.loads(told)["tests"]:
            properties = {p["name"]: p["value"] for p in t.get("properties", [])}
            environment = dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", []))
            tests[t["name"]] = (t["command"], environment, properties.get("WORKING_DIRECTORY", self.build))
        return tests


def render(text, span, edits, style):
    """What stands in the span with the edits made in it, outermost first."""
    out, at = [], span[0]
    inner = sorted((e for e in edits if span[0] <= e.span[0] and e.span[1] <= span[1]), key=lambda e: (e.span[0], -e.span[1]))
    for e in inner:
        if e.span[0] < at:
            continue  # inside one that has been rendered
        out.append(text[at:e.span[0]])
        out.append(replaced(text, e, edits, style))
        at = e.span[1]
    out.append(text[at:span[1]])
    return "".join(out)


def replaced(text, site, edits, style):
    rest = [e for e in edits if e is not site]

    def shown(span):
        return render(text, span, rest, style)

    same, changed, n = shown(site.span), changed_text(site, shown), site.number
    if style == "note":
        return noted(text, site, same, changed)
    if site.form == "bound":
        return f"({same}) {'+' if site.token == '<' else '-'} (floe_mutant == {n})"
    return f"(floe_mutant == {n} ? ({changed}) : ({same}))"


def noted(text, site, same, changed):
    """The value as it is, noting where the mutant's differs: always, where a second look might have effects or go wrong."""
    n, own = site.number, text[site.span[0]:site.span[1]]
    calls = any(own[i] == "(" and i > 0 and (own[i - 1].isalnum() or own[i - 1] == "_") for i in range(len(own)))
    effects = site.form in ("bound",) or site.token in ("&&", "||") or any(e in own.replace("==", "").replace("<=", "").replace(
        ">=", "").replace("!=", "") for e in EFFECTS)
    if site.reached or effects or (calls and site.form != "call"):
        return f"(floe_seen[{n}] = 1, ({same}))"
    if site.token in ("*", "/", "%", "*=", "/="):  # whole numbers might be divided by zero
        changed = f"__builtin_choose_expr(__builtin_types_compatible_p(__typeof__(same{n}), double), ({changed}), same{n} + 1)"
    return (f"(__extension__({{ __auto_type same{n} = ({same}); __auto_type other{n} = ({changed}); "
            f"if (same{n} != other{n}) floe_seen[{n}] = 1; same{n}; }}))")


def mutated_text(text, edits, style, header):
    body = render(text, (0, len(text)), edits, style)
    return ("#pragma GCC system_header\n" if header else "") + DECLARED[style] + body


def once(text, site):
    """The text with one mutant in it for good."""
    return text[:site.span[0]] + "(" + changed_text(site, lambda span: text[span[0]:span[1]]) + ")" + text[site.span[1]:]
