#!/usr/bin/env python3
"""Pages whose code is run: every block of a page in turn, in a folder of its own, and what it prints beside what the page says.

    scripts/tutorials.py check docs/tutorials/vessel.md docs/python.md    # status 1 if a block fails or prints something else
    scripts/tutorials.py write docs/tutorials/*.md                        # the same, and the pictures that the page shows are put beside it

Fenced blocks only: ```yaml FILE is written to the file (behind what is there, unless it begins with "floe:"), ```sh and ```python are run (with
`floe` the program in FLOE, and one namespace a page), ```text has lines that what was run last has printed, in this order; "..." stands for any
lines. Numbers agree to three figures.
"""
import argparse
import contextlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
FLOE = os.environ.get("FLOE", str(ROOT / "build/release/floe"))
sys.path.insert(0, str(ROOT / "python"))
os.environ.update(MPLBACKEND="Agg", FLOE_PYTHON=sys.executable, FLOE=FLOE)

BLOCK = re.compile(r"^```(\w+) ?(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
PICTURE = re.compile(r"!\[[^\]]*\]\(([\w.-]+)\)")
NUMBER = re.compile(r"(?<![\w.])[-+−]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?")


class Fault(Exception):
    pass


def rounded(line):
    return " ".join(NUMBER.sub(lambda m: f"{float(m.group().replace('−', '-')):.3g}", line).split())


def check_text(wanted, printed):
    """Each line of `wanted` is in what was printed, one behind the other."""
    rest = [rounded(line) for line in printed.splitlines()]
    for line in wanted.splitlines():
        if line.strip() in ("...", ""):
            continue
        if rounded(line) not in rest:
            raise Fault(f"'{line}' is not printed (any more, or at this place); what is:\n{printed}")
        rest = rest[rest.index(rounded(line)) + 1:]


def run_shell(code, folder):
    script = f'floe() {{ "$FLOE" "$@"; }}\nset -euo pipefail\n{code}'
    done = subprocess.run(["bash", "-c", script], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        raise Fault(f"exit status {done.returncode}:\n{done.stdout}")
    return done.stdout


def run_python(code, names, folder):
    out, before = io.StringIO(), os.getcwd()
    os.chdir(folder)
    try:
        with contextlib.redirect_stdout(out):
            exec(compile(code, "<block>", "exec"), names)
    finally:
        os.chdir(before)
    return out.getvalue()


def run_page(page, folder):
    text, names, printed = page.read_text(encoding="utf-8"), {"__name__": "__main__"}, ""
    for match in BLOCK.finditer(text):
        kind, name, code = match.groups()
        line = text.count("\n", 0, match.start()) + 1
        try:
            if kind == "yaml" and name:
                with open(folder / name, "w" if code.startswith("floe:") else "a", encoding="utf-8") as file:
                    file.write(code)
            elif kind == "sh":
                printed = run_shell(code, folder)
            elif kind == "python":
                printed = run_python(code, names, folder)
            elif kind == "text":
                check_text(code, printed)
        except Exception as error:
            raise Fault(f"{page.relative_to(ROOT)}:{line}: {type(error).__name__}: {error}") from error


def check_links(page):
    """What a page leads to in the repository is there."""
    for target in LINK.findall(page.read_text(encoding="utf-8")):
        if "://" not in target and not (page.parent / target).exists():
            raise Fault(f"{page.relative_to(ROOT)}: a link leads nowhere: {target}")


def pictures(page, folder, write):
    for name in PICTURE.findall(page.read_text(encoding="utf-8")):
        if write:
            shutil.copyfile(folder / name, page.parent / name)
        if not (folder / name).is_file() or not (page.parent / name).is_file():
            raise Fault(f"{page.relative_to(ROOT)}: no picture {name}, or none that its blocks make")


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("action", choices=["check", "write"])
    parser.add_argument("page", nargs="+", type=pathlib.Path)
    a = parser.parse_args()
    status = 0
    for page in (one.resolve() for one in a.page):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            (place / "inputs").symlink_to(ROOT / "inputs")
            try:
                check_links(page)
                run_page(page, place)
                pictures(page, place, a.action == "write")
                print(f"{page.relative_to(ROOT)}: every block runs", flush=True)
            except Fault as fault:
                print(fault, file=sys.stderr)
                status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
