"""Records of the bits of results: docs/results/bits/SOURCES.csv, one for each state of the sources that was recorded (scripts/same_bits.py record).

A record holds what a program made of those sources gives for every deck in each coupling in its first steps, for settings beyond the decks' own and for
commands that make tables of cases: a hash of every value. By two records a page is as good as made anew if what its decks give is the same bit by bit
under the sources that it was made from and under those that stand, even if two machines or compilers say so. What was not run proves nothing.

The columns: `what` (made: by which compiler, on which machine, in how many steps; sources: the hash of the sources without those modules, with those other files; as: the record that this one
is like, but for its rows; test: a test program whose figures a page shows; else the command of floe), the deck or the test's source, its coupling, the settings, a hash of that file, and what came of it: 'not run: ...', 'exit status N' and the hash
of what was said, or the hash of the results.
"""
import csv
import dataclasses
import io
import re

COLUMNS = ("what", "deck", "coupling", "settings", "of", "result")
FOLDER = "docs/results/bits"
GONE = "gone"
OF_METHOD = re.compile(r"\b(?:method|time)\.(\w+)")


@dataclasses.dataclass
class Record:
    sources: str
    made: str = ""
    whole: bool = True  # as written: no other record is needed to read it
    names: dict = dataclasses.field(default_factory=dict)  # hash of the sources by the modules left out
    rows: dict = dataclasses.field(default_factory=dict)   # (hash of the deck, result) by (what, deck, coupling, settings)


def read(folder):
    """All records of a folder, by the hash of all their sources."""
    tables = {path.stem: list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8")))) for path in sorted(folder.glob("*.csv"))}
    records = {}

    def take(stem):
        if stem in records:
            return records[stem]
        record = records[stem] = Record(stem)
        for row in tables[stem]:
            if row["what"] == "made":
                record.made = row["result"]
            elif row["what"] == "sources":
                record.names[row["settings"]] = row["result"]
            elif row["what"] == "as":
                record.rows, record.whole = dict(take(row["result"]).rows), False
            else:
                key = (row["what"], row["deck"], row["coupling"], row["settings"])
                record.rows[key] = (row["of"], row["result"])
                if row["result"] == GONE:
                    del record.rows[key]
        return record

    for stem in tables:
        take(stem)
    return records


def text_of(record, base=None):
    """A record as a file; `base`: a whole one, of whose rows only those are written that differ."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    writer.writerow(("made", "", "", "", "", record.made))
    for left_out, name in sorted(record.names.items()):
        writer.writerow(("sources", "", "", left_out, "", name))
    rows = record.rows
    if base:
        writer.writerow(("as", "", "", "", "", base.sources))
        rows = {key: value for key, value in rows.items() if base.rows.get(key) != value}
        rows.update({key: ("", GONE) for key in base.rows.keys() - record.rows.keys()})
    for key, value in sorted(rows.items()):
        writer.writerow(key + value)
    return out.getvalue()


def write(folder, records, kept):
    """Writes records into a folder: one whole, which stays the same one once there are others, those by what differs from it. Of the rest only the names in `kept` stay."""
    folder.mkdir(parents=True, exist_ok=True)
    base = next((one for one in records.values() if one.whole and (folder / f"{one.sources}.csv").exists()), None) or next(iter(records.values()))
    for name, one in records.items():
        path = folder / f"{name}.csv"
        if name in kept or one is base:
            path.write_text(text_of(one, base if one is not base else None), encoding="utf-8")
        else:
            path.unlink(missing_ok=True)


# ---- what a page needs ----

def keys_of(settings):
    return re.findall(r"([\w.]+)=", settings)


def sections(deck):
    """Of a deck the sections with which it varies itself."""
    found = re.findall(r"^(?:study|compare|stability):.*\n(?:[ #].*\n|\n)*", deck, re.MULTILINE)
    return "".join(found)


def words_of(commands, decks):
    """The words of a page's commands, and of what its decks vary."""
    words = set(re.findall(r"\w+", commands + "".join(sections(text) for text in decks)))
    return words | ({"basis"} if "bases" in words else set())


def couplings_of(deck):
    """The couplings that a deck's text names; [""], its own one, where it names none."""
    found = re.search(r"^runs_as: *\[(.*)\]", deck, re.MULTILINE)
    return [name.strip() for name in found.group(1).split(",")] if found else [""]


def needed(rows, commands, decks, also):
    """Those keys of rows that a page hangs on, by its commands, its decks {name: text} and other files: its decks as they are, every recorded setting of a key that it
    sets in a coupling of one of its decks, every recorded use of a command that it uses, the tests whose figures it shows."""
    words = words_of(commands, decks.values())
    couplings = {name for text in decks.values() for name in couplings_of(text)}
    used = set(re.findall(r"^ *floe (\w+)", commands, re.MULTILINE)) - {"run"}
    preset = re.search(r"\bmethod=", commands)
    for key in sorted(rows):
        what, deck, coupling, settings = key
        keys = keys_of(settings)
        if what == "test":
            if deck in also:
                yield key
        elif what == "run" and not settings:
            if deck in decks:
                yield key
        elif coupling and not couplings & {coupling, ""}:
            continue
        elif what != "run":
            if what in used:
                yield key
        elif any(one.split(".")[-1] in words for one in keys) or (preset and any(one.startswith("method") for one in keys)):
            yield key


def unrecorded(rows, commands, decks, also, texts):
    """What of a page's runs no row could show: decks, tests, keys of the method and of time; `texts`: of all decks that are recorded."""
    for name in also:
        if not any(key[:2] == ("test", name) for key in rows):
            yield f"{name} is not recorded"
    for deck in decks:
        if not any(key[:2] == ("run", deck) for key in rows):
            yield f"{deck} is not recorded"
    known = {one.split(".")[-1] for key in rows for one in keys_of(key[3])} | {"max_steps"}
    for name in sorted(set(OF_METHOD.findall(commands)) - known):
        if not any(re.search(rf"\b{name}:", text) for text in texts):
            yield f"no recorded run sets {name}"


def differences(before, after, commands, decks, also, deck_hash, texts):
    """Why two records do not show that a page's results are the same; nothing: they are. `deck_hash(name)`: of a deck or a test as it is."""
    if not re.search(r"^ *floe \w+", commands, re.MULTILINE):
        return ["no command of floe is on the page"]
    why = list(unrecorded(after.rows, commands, decks, also, texts))
    for key in needed({**before.rows, **after.rows}, commands, decks, also):
        (old_deck, old), (new_deck, new) = before.rows.get(key, ("", "")), after.rows.get(key, ("", ""))
        what, deck, coupling, settings = key
        name = " ".join(filter(None, (what if what != "run" else "", deck, coupling, settings)))
        if not (old_deck and old_deck == new_deck == deck_hash(deck)):
            why.append(f"{name} is not recorded for both")
        elif old.startswith("not run") or new.startswith("not run"):
            why.append(f"{name} was not run")
        elif old != new:
            why.append(f"other bits of {name}")
    if before.made != after.made and why:  # equal results of two machines say as much as those of one; unequal ones may be the machines'
        why.insert(0, "recorded by another compiler, on another machine or in other steps")
    return why
