"""Numbers and tables in Markdown."""
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
