#!/usr/bin/python3
"""structure.py: the tables of modules and parts in docs/structure.md.

    scripts/structure.py write    fills in headers, largest files and lines of code
    scripts/structure.py check    exit status 1, and what differs, where a table is not true

A table must have a row for each module, or each part of mpm and ice, in the right layer, and name the headers that others include. Of numbers `check` wants a tenth:
ordinary changes of a file need no new table."""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/structure.md"
SLACK = 0.1  # of a number of lines


def code_lines(path):
    """Lines of a C file that hold more than blanks and comments."""
    text = re.sub(r'"(\\.|[^"\\\n])*"|/\*.*?\*/', lambda m: "x" if m[0][0] == '"' else "\n" * m[0].count("\n"), path.read_text(), flags=re.DOTALL)
    return sum(1 for line in text.splitlines() if line.strip())


SOURCES = {path.relative_to(ROOT / "src"): code_lines(path) for path in sorted((ROOT / "src").rglob("*.[ch]"))}
INCLUDES = {path: re.findall(r'^#include "(.+)"', (ROOT / "src" / path).read_text(), flags=re.MULTILINE) for path in SOURCES}


def layers():
    text = re.search(r"set\(FLOE_LAYERS(.*?)\)", (ROOT / "cmake/FloeModule.cmake").read_text(), flags=re.DOTALL)[1]
    return {module: str(k + 1) for k, layer in enumerate(re.findall(r'"(.+?)"', text)) for module in layer.split()}


def group_of(path, module=None):
    """The module of a file; or its part, of one module."""
    if module is None:
        return path.parts[0]
    return (path.parts[1] if len(path.parts) > 2 else module) if path.parts[0] == module else None


def shown_by(module=None):
    """Headers of a group that files of other groups include, without the folder."""
    shown = collections.defaultdict(set)
    for path, headers in INCLUDES.items():
        for header in map(pathlib.Path, headers):
            group = group_of(header, module) if header in SOURCES else None
            if group and group_of(path, module) != group:
                shown[group].add(str(header.relative_to(header.parts[0]) if module is None else header.name))
    return shown


def measures(module=None):
    files = collections.defaultdict(dict)
    for path, lines in SOURCES.items():
        if group_of(path, module):
            files[group_of(path, module)][path] = lines
    return {group: (max(of, key=of.get), sum(of.values())) for group, of in files.items()}


class Table:
    """A table of the page under the first heading that has one; rows by the name in a column."""

    def __init__(self, lines, heading):
        at = lines.index(heading)
        first = next(k for k in range(at, len(lines)) if lines[k].startswith("|"))
        last = next(k for k in range(first, len(lines)) if not lines[k].startswith("|"))
        self.columns = self.cells(lines[first])
        self.rows = {k: dict(zip(self.columns, self.cells(lines[k]))) for k in range(first + 2, last)}

    @staticmethod
    def cells(line):
        return [cell.strip() for cell in line.strip().strip("|").split("|")]

    def line(self, row):
        return "|" + "|".join(f" {row[column]} " if row[column] else " " for column in self.columns) + "|"


def parts_seen(module):
    """Of each part the parts whose headers it sees, as its CMakeLists.txt has them: `floe_parts(ice sides: ${state} points)`."""
    text = (ROOT / "src" / str(module) / "CMakeLists.txt").read_text() if module else ""
    return {part: ", ".join(re.findall(r"\w+", seen)) for part, seen in re.findall(rf"floe_parts\({module} (\w+):(.*?)\)", text) if part != module}


def fill(table, module):
    """Sets what is counted; returns the rows by their group, and complaints about the rest."""
    measured, shown, layer, sees, found, wrong = measures(module), shown_by(module), layers(), parts_seen(module), {}, []
    for row in table.rows.values():
        group = row["module" if module is None else "part"].split(" ")[0]
        found[group] = row
        if group not in measured:
            wrong.append(f"there is no {group}")
            continue
        largest, lines = measured[group]
        row["largest file"] = f"`{largest.relative_to(largest.parts[0]) if module is None else largest.name}` ({SOURCES[largest]})"
        row["lines"] = str(lines)
        if module is None:
            row["headers"] = ", ".join(f"`{name[:-2]}`" for name in sorted(shown[group]))
            if row["layer"] != layer[group]:
                wrong.append(f"{group} is in layer {layer[group]}")
        elif "shows" in row:
            named = set(re.findall(r"`(\w+\.h)`", row["shows"]))
            wrong += [f"{module}/{group} shows {name}" for name in sorted(shown[group] - named)]
            wrong += [f"{module}/{group} does not show {name}" for name in sorted(named - shown[group])]
        elif group in sees and row["sees"] != sees[group]:
            wrong.append(f"{module}/{group} sees {sees[group]}")
    wrong += [f"no row for {group}" for group in sorted(measured.keys() - found.keys())]
    return wrong


def near(old, new):
    return abs(int(old) - int(new)) <= SLACK * int(new)


def is_true(old, new):
    """Whether a cell says what has been counted: the same words, and numbers that are near. Of two files of almost one size either may be the largest."""
    if old == new or (old.isdigit() and new.isdigit() and near(old, new)):
        return True
    ours, theirs = (re.fullmatch(r"`(.+)` \((\d+)\)", cell) for cell in (old, new))
    sizes = [lines for path, lines in SOURCES.items() if ours and str(path).endswith(f"/{ours[1]}")]
    return bool(theirs and any(near(ours[2], lines) and near(lines, theirs[2]) for lines in sizes))


def main():
    if len(sys.argv) != 2 or sys.argv[1] not in ("write", "check"):
        sys.exit(__doc__)
    lines, wrong = PAGE.read_text().split("\n"), []
    new = list(lines)
    for heading, module in (("## Modules and layers", None), ("### Parts of mpm", "mpm"), ("### Parts of ice", "ice")):
        table = Table(lines, heading)
        wrong += fill(table, module)
        for k, row in table.rows.items():
            new[k] = table.line(row)
            for old, cell in zip(Table.cells(lines[k]), Table.cells(new[k])):
                if sys.argv[1] == "check" and not is_true(old, cell):
                    wrong.append(f"'{old}' is '{cell}' (scripts/structure.py write): {lines[k][:60]}...")
    if sys.argv[1] == "write":
        PAGE.write_text("\n".join(new))
    for text in wrong:
        print(f"docs/structure.md: {text}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
