"""Numbers and tables, in Markdown and in notebooks."""
import html
import math


def figure(value, digits=3):
    """A number to so many significant digits; "-" where there is none."""
    return f"{value:.{digits}g}" if value is not None and math.isfinite(value) else "-"


def percent(value, digits=3):
    """A share as a percentage."""
    return figure(100 * value, digits) + " %" if value is not None and math.isfinite(value) else "-"


def markdown(header, rows):
    """A table as lines of Markdown; numbers are written by `figure`, all else as it prints."""
    def cell(value):
        return (figure(value) if isinstance(value, float) else str(value)).replace("|", "\\|")

    lines = ["| " + " | ".join(map(cell, header)) + " |", "|" + "---|" * len(header)]
    for row in rows:
        if len(row) != len(header):
            raise ValueError(f"a row of {len(row)} cells under a header of {len(header)}: {row}")
        lines.append("| " + " | ".join(map(cell, row)) + " |")
    return lines


class Table:
    """A table that prints as Markdown and stands in notebooks as a table; numbers are written by `figure`."""

    def __init__(self, header, rows):
        self.header, self.rows = list(header), [list(row) for row in rows]
        markdown(self.header, self.rows)  # refuses rows of other lengths

    def __str__(self):
        return "\n".join(markdown(self.header, self.rows))

    __repr__ = __str__

    def _repr_html_(self):
        def line(cells, tag):
            return "<tr>" + "".join(f"<{tag}>{html.escape(figure(one) if isinstance(one, float) else str(one))}</{tag}>" for one in cells) + "</tr>"
        return "\n".join(["<table>", line(self.header, "th"), *(line(row, "td") for row in self.rows), "</table>"])
