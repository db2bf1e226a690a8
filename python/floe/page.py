"""A page in the making: what its sections share. Figures and pictures are written beside it and stand in it."""
import base64
import dataclasses
import pathlib

from markupsafe import Markup

from . import figures, files, pictures, snapshots, svg
from .figures import Figure
from .files import Refused
from .snapshots import Run

#: Pictures through time of one run, and of cases side by side.
MOST_FRAMES, MOST_CASES = 12, 12
#: Bytes of figures and pictures from which on a page hands out numbers from the files beside it, and holds no copy of them.
BUDGET = 1_200_000


@dataclasses.dataclass
class Drawn:
    """A figure on the page."""
    title: str
    svg: Markup
    name: str
    data: str  # its numbers, as base64; "": they stand beside the page alone


@dataclasses.dataclass
class Frame:
    """A picture on the page."""
    title: str
    svg: Markup
    caption: str


@dataclasses.dataclass
class Section:
    """A part of the page: the results of one folder. `data` are what its template shows."""
    id: str
    title: str
    kind: str
    data: dict
    parts: list[tuple[str, str]] = dataclasses.field(default_factory=list)  # id and title, for the table of contents


@dataclasses.dataclass
class Page:
    folder: pathlib.Path                 # of what stands beside it
    times: list[float]                   # of the pictures; none: through the whole run
    warn: object                         # warn(text): tells the user
    sections: list[Section] = dataclasses.field(default_factory=list)
    cards: list[dict] = dataclasses.field(default_factory=list)
    warned: dict[str, list[str]] = dataclasses.field(default_factory=dict)  # what, and whose
    size: int = 0                        # bytes of figures and pictures so far
    thinned: bool = False

    def section(self, title: str, kind: str) -> Section:
        section = Section(f"s{len(self.sections) + 1}", title, kind, {})
        self.sections.append(section)
        return section

    def stem(self, folder: pathlib.Path) -> str:
        """Before the names of the files of the latest section."""
        return f"{len(self.sections):02d}-{folder.resolve().name[:90]}"

    def warning(self, whose: str, text: str) -> None:
        whose_too = self.warned.setdefault(text, [])
        if whose not in whose_too:
            whose_too.append(whose)

    @property
    def warnings(self) -> list[tuple[str, str]]:
        """Each warning once: the first whose it is and how many more, and the text."""
        return [(whose[0] + (f" and {len(whose) - 1} more" if len(whose) > 1 else ""), text) for text, whose in self.warned.items()]

    @property
    def full(self) -> bool:
        return self.size > BUDGET

    def draw(self, wanted: list[Figure]) -> list[Drawn]:
        """Writes figures beside the page, and returns them for it."""
        out = []
        for figure in wanted:
            files.make_folder(self.folder)
            thin = figures.thinned_figure(figure)
            self.thinned = self.thinned or thin != figure
            element = figures.write(self.folder, figure)
            data = base64.b64encode(figures.csv_text(thin, 6).encode()).decode() if not self.full else ""
            self.size += len(element) + len(data)
            out.append(Drawn(figure.title, Markup(element), files.stem(figure.name), data))
        return out

    def frame(self, sheet: pictures.Sheet, ranges, name: str, title: str = "") -> Frame:
        """Writes a picture beside the page, and returns it for it."""
        files.make_folder(self.folder)
        name = files.stem(name)
        drawn = pictures.sheet_figure(sheet, ranges)
        drawn.patch.set_visible(False)
        element = svg.inline(drawn, name, sheet.caption)
        files.replace(self.folder / f"{name}.svg", svg.alone(element))
        self.size += len(element)
        return Frame(title, Markup(element), sheet.caption)

    def _chosen(self, run: Run) -> list[snapshots.SealedSnapshot]:
        """The snapshots nearest to the wanted times, else an even choice of them, the first and the last included."""
        every = snapshots.snapshots(run.folder, self.warn)
        if self.times:
            chosen = [min(every, key=lambda one: abs(one.time - time)) for time in self.times]
        else:
            last = len(every) - 1
            chosen = [every[round(k * last / max(1, min(MOST_FRAMES, len(every)) - 1))] for k in range(min(MOST_FRAMES, len(every)))]
        return sorted(dict.fromkeys(chosen), key=lambda one: one.time)

    def film(self, run: Run, stem: str) -> list[Frame]:
        """Pictures of a run through time, all with the same ranges. Without one where that fails, which is said."""
        if not (run.folder / "fields").is_dir():
            return []
        try:
            options = pictures.Options(titled=False)
            sheets = [pictures.make_sheet(one, options) for one in self._chosen(run)]
            ranges = pictures.common_ranges(sheets)
            return [self.frame(sheet, ranges, f"{stem}-{sheet.snapshot.path.stem}") for sheet in sheets]
        except Refused as error:
            self.warn(f"no pictures of '{run.folder}': {error}")
            self.warning(run.title, f"No pictures: {error}")
            return []

    def side_by_side(self, runs: list[tuple[str, Run]], stem: str) -> list[Frame]:
        """The last pictures of several runs (title, run), with the same ranges where they show the same."""
        sheets = []
        for title, run in runs[:MOST_CASES]:
            try:
                if snapshots.snapshot_files(run.folder):
                    sheets.append((title, run, pictures.make_sheet(snapshots.snapshots(run.folder, self.warn, 1)[0], pictures.Options(titled=False))))
            except Refused as error:
                self.warn(f"no pictures of '{run.folder}': {error}")
        shown = {tuple(scale.label for scale in sheet.scales) for _, _, sheet in sheets}
        ranges = pictures.common_ranges([sheet for _, _, sheet in sheets]) if len(shown) == 1 else None
        return [self.frame(sheet, ranges, f"{stem}-{run.folder.name}-{sheet.snapshot.path.stem}", title) for title, run, sheet in sheets]
