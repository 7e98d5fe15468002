"""Basis of a report: scope, limit profile, ranges, inputs, default values, notes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from netdesign.report.blocks import (
    Block,
    Cell,
    Column,
    Heading,
    Items,
    Pair,
    Pairs,
    Paragraph,
    Part,
    Table,
    given_cell,
    key_columns,
    section,
    symbols,
    text_cell,
)
from netdesign.report.words import (
    MISSING,
    Words,
    name_heading,
    show_own,
    show_text,
    show_unit,
    understand,
)
from netdesign.site.model import InputEcho
from netdesign.study.records import ProfileRecord, RowStudy, Study
from netdesign.words.message import Message, say
from netdesign.words.names import name

DEFAULT = "default"  # cell of an input that nobody typed
_ACROSS = 8  # rows of nets beside each other on a page
_BY_DEFAULT, _DERIVED = "*", "‡"


def build_inputs(inputs: Sequence[InputEcho], caption: str, words: Words) -> Table:
    """List inputs as typed and as understood, each with its cell."""
    keys = ("input", "typed", "understood_as", "unit", "cell")
    return Table(
        caption=caption,
        columns=key_columns(words, "heading.", keys, numbers=("understood_as",)),
        rows=tuple(
            (
                text_cell(words.show(echo.label)),
                text_cell(
                    words.show(echo.derivation) if echo.derivation else echo.text
                ),
                given_cell(words, understand(echo, words)),
                text_cell(show_unit(echo.unit)),
                text_cell(
                    words("status.default") if echo.cell == DEFAULT else echo.cell
                ),
            )
            for echo in inputs
        ),
        empty=words("show.none"),
    )


def show_inputs(study: Study, words: Words) -> Part:
    """Section of all rows' inputs as understood, a column for each row."""
    starts = range(0, max(len(study.rows), 1), _ACROSS)
    tables = [_build_inputs(study.rows[k : k + _ACROSS], words) for k in starts]
    return section(
        "inputs",
        words("heading.inputs_of_rows"),
        *(one.shown("site-inputs") for one in tables),
        look="wide",
    )


def _build_inputs(rows: Sequence[RowStudy], words: Words) -> Table:
    """Inputs of some rows; one that all of them leave empty is left out."""
    lines: dict[tuple[str, str], dict[str, InputEcho]] = {}
    for row in rows:
        for echo in row.inputs:
            place = (words.show(echo.label), echo.unit)
            lines.setdefault(place, {})[row.id] = echo
    return Table(
        caption=words("caption.site_inputs"),
        columns=(
            *key_columns(words, "heading.", ("input", "column_of", "unit")),
            *(Column(heading=show_text(row.id)) for row in rows),
        ),
        rows=tuple(
            (
                text_cell(label),
                text_cell(_name_column(list(by_row.values()))),
                text_cell(show_unit(unit)),
                *(_show_input(by_row.get(row.id), words) for row in rows),
            )
            for (label, unit), by_row in lines.items()
            if any(echo.value not in ("", row_id) for row_id, echo in by_row.items())
        ),
        empty=words("show.none"),
    )


def _show_input(echo: InputEcho | None, words: Words) -> Cell:
    if echo is None or echo.value == "":
        return text_cell(MISSING)
    mark = _BY_DEFAULT if echo.cell == DEFAULT else ""
    text = show_value(echo, words)
    return text_cell(text + mark + (_DERIVED if echo.derivation else ""))


def show_value(echo: InputEcho, words: Words) -> str:
    """Input as it was typed; a length that follows from others, in cm."""
    value = understand(echo, words)
    if isinstance(value, str):
        return value
    is_length = echo.unit == "m" and echo.derivation
    return words.show_fixed(value, 2) if is_length else words.show_given(value)


def _name_column(echoes: Sequence[InputEcho]) -> str:
    """Sheet and column of an input, of the rows that have it: ``Nets!C``.

    A cell that several rows share stands whole: its value holds for all of them.
    """
    cells = [echo.cell for echo in echoes if echo.cell != DEFAULT]
    places = {
        one if cells.count(one) > 1 else one.rstrip("0123456789") for one in cells
    }
    return ", ".join(sorted(places))


_ASSUMED = "assumed"  # status of a value that nobody has confirmed


def show_profile(study: Study, words: Words) -> Part:
    """Annex with the values of the profile; sources that recur have numbers."""
    numbered, sources = _number_sources(build_profile(study, words))
    return section(
        "annex-profile",
        words("heading.annex_profile"),
        Paragraph(text=name_profile(study, words)),
        numbered.shown("profile"),
        *(Paragraph(text=source, look="small") for source in sources),
    )


def build_profile(study: Study, words: Words) -> Table:
    """Values of the limit profile."""
    keys = ("clause", "value_of", "value", "unit", "status", "source")
    return Table(
        caption=words("caption.every_value"),
        columns=key_columns(words, "heading.", keys, numbers=("value",)),
        rows=tuple(
            (
                text_cell(value.clause),
                text_cell(show_own(words, value.text)),
                given_cell(words, value.value),
                text_cell(show_unit(value.unit)),
                text_cell(words.show(name("status", value.status))),
                text_cell(show_own(words, value.source)),
            )
            for value in study.profile.values
        ),
        empty=words("show.none"),
    )


def _number_sources(table: Table) -> tuple[Table, tuple[str, ...]]:
    """The table with a number for each source, and the sources below it."""
    sources = dict.fromkeys(cells[-1].text for cells in table.rows)
    numbers = {source: f"[{k}]" for k, source in enumerate(sources, 1)}
    rows = tuple(
        (*cells[:-1], text_cell(numbers[cells[-1].text])) for cells in table.rows
    )
    told = tuple(f"{number} {source}" for source, number in numbers.items())
    return replace(table, rows=rows), told


def name_profile(study: Study, words: Words) -> str:
    """Title and edition of the limit profile."""
    return show_own(words, f"{study.profile.title}, {study.profile.edition}")


def count_assumed(study: Study) -> tuple[int, int]:
    """Values of the profile that nobody has confirmed, and all of them."""
    values = study.profile.values
    return sum(one.status == _ASSUMED for one in values), len(values)


def list_odd_values(profile: ProfileRecord, words: Words) -> tuple[str, ...]:
    """Values below 1 or beyond what any document has, each with its reason."""
    return tuple(
        words(
            "show.label",
            label=f"{show_own(words, value.text)} = "
            f"{words.show_quantity(value.value, value.unit)}",
            text=words(key, reason=show_text(reason)),
        )
        for value in profile.values
        for key, reason in value.reasons.items()
    )


_SCOPE = ("avalanche", "structure", "ground", "product")
_READING = (
    *("reading.checks", "caption.chains", "caption.arrows", "reading.pressure"),
    *("panel_view.caption", "reading.search"),
    "reading.directions",
)
# Left empty, its factor is taken by the guideline's load.
_ALTITUDE = say("column.Nets.altitude")
_NAME = say("column.Nets.id")
# Net rows of which each is named; of more, those that are left out may be fewer.
_FEW_ROWS = 8


def show_basis(study: Study, words: Words) -> Part:
    """Statements that hold for all rows."""
    reading = tuple(symbols(one) for one in list_reading(study, words))
    defaults = list_defaults(study, words)
    notes = list_notes(study, words)
    listed: dict[str, tuple[Block, ...]] = {
        "scope": list_scope(study, words),
        "limit_profile": tuple(_list_profile(study, words)),
        "ranges": (show_ranges(study, words).shown("inputs"),),
        "not_typed": (_list(defaults, words),),
        "notes": (_list(notes, words),),
        "reading": (Items(items=reading, look="small"),),
    }
    sections = (
        section(name, words(f"heading.{name}"), *blocks, level=3)
        for name, blocks in listed.items()
    )
    heading = Heading(text=words("heading.basis"), level=2)
    return Part(kind="article", id="basis", blocks=(heading, *sections))


def list_scope(study: Study, words: Words) -> tuple[Block, ...]:
    """Statements of what is treated, and who must check what is not."""
    return Paragraph(text=words("scope.treated")), _tabulate_scope(study, words)


def _list(sentences: Sequence[str], words: Words) -> Block:
    if not sentences:
        return Paragraph(text=words("show.none"), look="none")
    return Items(items=tuple(sentences))


def _tabulate_scope(study: Study, words: Words) -> Table:
    """Topics that the study does not treat, those that its profile leaves out first."""
    return Table(
        caption=words("scope.decision"),
        columns=key_columns(words, "heading.", ("not_treated", "who_checks")),
        rows=tuple(
            (text_cell(words(f"scope.{key}")), text_cell(words(f"scope.{key}_by")))
            for key in (*study.profile.not_checked, *_SCOPE)
        ),
        look="scope",
    )


def _list_profile(study: Study, words: Words) -> Iterator[Block]:
    """The limit profile in some lines, and the least load."""
    profile = study.profile
    assumed, count = count_assumed(study)
    told = {
        "limit_profile": name_profile(study, words),
        "profile_version": profile.version,
        "profile_choice": show_own(words, profile.choice_text or profile.choice),
        "unconfirmed": words("show.assumed_counted", assumed=assumed, count=count),
        "floor": describe_floor(study, words),
    }
    pairs = tuple(
        Pair(name=words(f"heading.{key}"), text=show_text(text))
        for key, text in told.items()
        if text
    )
    yield Pairs(pairs=pairs, look="keys")
    odd = list_odd_values(profile, words)
    if odd:
        yield Items(items=odd)


def has_other_floor(study: Study) -> bool:
    """No minimum load is taken, another one than the profile has, or it decides."""
    is_other = study.profile.floor == "none" or study.profile.is_floor_overruled
    return is_other or study.profile.is_by_guideline


def describe_floor(study: Study, words: Words) -> str:
    """Least load of the design forces, and how often it governs."""
    told = _count_by_floor(study, words)
    if study.profile.is_by_guideline:
        told = words.join([words("floor.decides"), told])
    if not study.profile.has_maker_floor:
        told = words.join([told, words("floor.no_maker")])
    if not study.profile.is_floor_overruled:
        return told
    return words.join([words("floor.overruled", profile=study.profile.id), told])


def _count_by_floor(study: Study, words: Words) -> str:
    if study.profile.floor == "none":
        is_own = not study.profile.is_floor_overruled
        return words("floor.none" if is_own else "floor.none_chosen")
    checks = [one for row in study.rows for one in row.checks if one.is_of_force]
    governed = sum(one.governs == "guideline" for one in checks)
    profiles = {row.floor.profile for row in study.rows if row.floor}
    named = show_text(", ".join(sorted(profiles)))
    return words("floor.told", profile=named, count=governed, all=len(checks))


def name_law(study: Study) -> str:
    """Creep law of a study; "" of one that does not say."""
    return study.provenance.settings.get("creep_law", "").partition(" ")[0]


def show_ranges(study: Study, words: Words) -> Table:
    """Ranges of the envelope as typed and as understood."""
    return build_inputs(study.range_inputs, words("heading.ranges_of_envelope"), words)


def list_notes(study: Study, words: Words) -> list[str]:
    """Notes on the whole study, and those that several rows share."""
    return [
        *(words.show(note) for note in study.notes),
        *label_rows(share_notes(study, words), study, words),
    ]


# Notes on what is known beside the verdict: they stand with the second opinions.
_BESIDE = ("model_code", "loaded_net", "guys_in_snow")
# Told among the points that are open; the schedule has the dip of every borehole.
_OPEN = "row.borehole_rises"


def is_of_row(note: Message) -> bool:
    """A note for the page of its row: neither an open point nor beside the verdict."""
    return note.key != _OPEN and not is_beside_verdict(note)


def is_beside_verdict(note: Message) -> bool:
    """A note that asks nothing of anyone, as no number of it decides."""
    return note.key.rpartition(".")[2] in _BESIDE


def share_notes(study: Study, words: Words) -> dict[str, list[str]]:
    """Notes that several rows have, word by word, with the rows: told once."""
    notes = group_notes(study, words, is_beside=False)
    return {note: ids for note, ids in notes.items() if len(ids) > 1}


def group_notes(
    study: Study, words: Words, *, is_beside: bool, but: Sequence[str] = ()
) -> dict[str, list[str]]:
    """Rows of each note, word by word: of those beside the verdict, or the others.

    Left out are those with the keys ``but``.
    """
    rows: dict[str, list[str]] = {}
    for row in study.rows:
        notes = [
            one
            for one in row.notes
            if one.key not in (_OPEN, *but) and is_beside_verdict(one) is is_beside
        ]
        for note in dict.fromkeys(words.show(one) for one in notes):
            rows.setdefault(note, []).append(show_text(row.id))
    return rows


def list_reading(study: Study, words: Words) -> tuple[str, ...]:
    """Sentences that hold of the drawings and tables of every row."""
    return name_cases(study, words), *(words(key) for key in _READING)


def name_cases(study: Study, words: Words) -> str:
    """Legend of the numbers of a case, in their order."""
    points = [case.case for row in study.rows for case in row.cases[:1]]
    names = (
        [name_heading(words, key) for key in [*points[0].values][3:]] if points else []
    )
    legend = words("show.legend")
    if not names:
        return legend
    return words("show.legend_further", legend=legend, names=" / ".join(names))


def list_defaults(study: Study, words: Words) -> list[str]:
    """Values that nobody typed, what they were taken as, and where.

    A range without a number of samples is searched: that is no value.
    """
    found: dict[tuple[str, str], list[str]] = {}
    numbers = [one for one in study.range_inputs if isinstance(one.value, float)]
    places = [(words("heading.ranges"), numbers)]
    places += [(row.id, row.inputs) for row in study.rows]
    for place, inputs in places:
        for echo in inputs:
            label = words.show(echo.label)
            if echo.cell == DEFAULT and echo.value != "":
                shown = words.show_quantity(understand(echo, words), echo.unit)
                found.setdefault((label, shown), []).append(place)
            elif echo.label == _ALTITUDE and echo.value == "":
                shown = words("show.largest_altitude_factor")
                found.setdefault((label, shown), []).append(place)
    return [
        words(
            "show.default_taken",
            what=what,
            value=value,
            who=show_text(name_rows(who, study, words)),
        )
        for (what, value), who in found.items()
    ]


def anchor_rows(study: Study) -> dict[str, str]:
    """Place of each net row in the page; rows alike but for their names share one."""
    anchors: dict[str, str] = {}
    known: list[tuple[RowStudy, str]] = []
    for number, row in enumerate(study.rows, 1):
        plain = _leave_out_name(row)
        found = (anchor for other, anchor in known if other == plain)
        anchors[row.id] = next(found, f"row-{number}")
        known.append((plain, anchors[row.id]))
    return anchors


def _leave_out_name(row: RowStudy) -> RowStudy:
    """The row as if it stood in no line of a workbook."""
    inputs = [replace(one, cell="") for one in row.inputs if one.label != _NAME]
    return replace(row, id="", inputs=inputs)


def label_rows(
    rows: Mapping[str, Sequence[str]], study: Study, words: Words
) -> list[str]:
    """Sentences, each behind the net rows of which it holds."""
    return [
        words("show.label", label=show_text(name_rows(ids, study, words)), text=one)
        for one, ids in rows.items()
    ]


def name_rows(names: Sequence[str], study: Study, words: Words) -> str:
    """Names of net rows; of a large site all of them, or all but a few, in a phrase.

    What is named beside them, such as the ranges, stands before.
    """
    ids = [row.id for row in study.rows]
    beside = [name for name in names if name not in ids]
    others = [name for name in ids if name not in names]
    is_short = len(names) <= len(others)
    if len(ids) <= _FEW_ROWS or len(others) > _FEW_ROWS or is_short:
        return ", ".join(names)
    key = "show.all_rows_but" if others else "show.all_rows"
    told = words(key, count=len(ids), others=", ".join(others))
    return ", ".join([*beside, told])
