#!/usr/bin/env python3
"""Notebooks without Jupyter: runs their cells in order, and writes their outputs, or says where they are others.

    scripts/notebooks.py write docs/notebooks/*.ipynb     # cells are run, outputs written into the files
    scripts/notebooks.py check docs/notebooks/*.ipynb     # cells are run, nothing is written; status 1 if a text is another

A cell's outputs are what it prints, its last expression (as text, table or picture), and figures of pyplot, as in Jupyter. Numbers of texts agree
to four figures; pictures are compared by their presence. Notebooks run in a copy of their place: a folder docs/notebooks beside a link to inputs.
"""
import argparse
import ast
import base64
import contextlib
import io
import json
import os
import pathlib
import re
import sys
import tempfile
import traceback

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python"))
os.environ["MPLBACKEND"] = "Agg"


def lines(text):
    return text.splitlines(keepends=True)


def image(png):
    return {"data": {"image/png": base64.b64encode(png).decode(), "text/plain": ["<picture>"]}, "metadata": {}, "output_type": "display_data"}


def shown(value, count):
    """The output of a last expression."""
    data = {}
    for kind, method in (("image/png", "_repr_png_"), ("text/html", "_repr_html_")):
        if hasattr(value, method):
            made = getattr(value, method)()
            if made is not None:
                data[kind] = base64.b64encode(made).decode() if kind == "image/png" else lines(made)
    data["text/plain"] = ["<picture>"] if "image/png" in data else lines(repr(value))
    return {"data": data, "execution_count": count, "metadata": {}, "output_type": "execute_result"}


def figures():
    """What pyplot holds, as pictures; it is closed."""
    pyplot = sys.modules.get("matplotlib.pyplot")
    if not pyplot:
        return
    for number in pyplot.get_fignums():
        out = io.BytesIO()
        pyplot.figure(number).savefig(out, format="png", dpi=72, bbox_inches="tight", metadata={"Software": None})
        yield image(out.getvalue())
    pyplot.close("all")


def run_cell(source, names, count):
    """The outputs of a cell."""
    tree, printed, last = ast.parse(source), io.StringIO(), None
    if tree.body and isinstance(tree.body[-1], ast.Expr) and not source.rstrip().endswith(";"):
        last = ast.Expression(tree.body.pop().value)
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, f"<cell {count}>", "exec"), names)
        value = eval(compile(last, f"<cell {count}>", "eval"), names) if last else None
    outputs = [{"name": "stdout", "output_type": "stream", "text": lines(printed.getvalue())}] if printed.getvalue() else []
    outputs += figures()
    return outputs + ([shown(value, count)] if value is not None else [])


def text_of(output):
    return "".join(output.get("text") or output["data"].get("text/plain", []))


def same(one, other):
    """Whether two texts agree, numbers to four figures."""
    def rounded(match):
        return f"{float(match.group()):.4g}"
    number = r"[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?"
    return re.sub(number, rounded, one) == re.sub(number, rounded, other)


def run_notebook(path, write):
    """Runs it; the faults that were found."""
    book, names, faults = json.loads(path.read_text(encoding="utf-8")), {"__name__": "__main__"}, []
    for count, cell in enumerate((one for one in book["cells"] if one["cell_type"] == "code"), 1):
        try:
            outputs = run_cell("".join(cell["source"]), names, count)
        except Exception:
            return faults + [f"{path.name}, cell {count}: {traceback.format_exc(limit=-3)}"]
        was = cell["outputs"]
        if not write and ([one["output_type"] for one in was] != [one["output_type"] for one in outputs] or
                          not all(same(text_of(a), text_of(b)) for a, b in zip(was, outputs))):
            faults.append(f"{path.name}, cell {count}: another output:\n{''.join(map(text_of, outputs))}\ninstead of:\n{''.join(map(text_of, was))}")
        cell["outputs"], cell["execution_count"] = outputs, count
    if write:
        path.write_text(json.dumps(book, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("action", choices=["write", "check"])
    parser.add_argument("notebook", nargs="+", type=pathlib.Path)
    a = parser.parse_args()
    faults = []
    for path in (one.resolve() for one in a.notebook):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder) / "docs/notebooks"
            place.mkdir(parents=True)
            (pathlib.Path(folder) / "inputs").symlink_to(ROOT / "inputs")
            os.chdir(place)
            faults += run_notebook(path, a.action == "write")
            os.chdir(ROOT)
        print(path.name, "written" if a.action == "write" else "checked", flush=True)
    for one in faults:
        print(one, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
