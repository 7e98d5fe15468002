"""Winter document -> folder: page without script, and JSON.

All numbers shown are the document's.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from netdesign.addons.winter.figure import draw_measured, draw_winter
from netdesign.report.blocks import (
    Block,
    Cell,
    Figure,
    Heading,
    Paragraph,
    Part,
    Table,
    fixed_cell,
    force_cell,
    key_columns,
    masthead,
    name_columns,
    notes,
    section,
    text_cell,
)
from netdesign.report.page import render_page
from netdesign.report.words import (
    ENGLISH,
    MISSING,
    Words,
    name_row,
    show_member,
    show_text,
)

PAGE_FILE, DOCUMENT_FILE = "winter.html", "winter.json"


def render_winter(document: Mapping[str, Any]) -> dict[str, bytes]:
    """Contents of both files by name.

    Parameters
    ----------
    document : mapping
        As ``files.winter.write_winter_document`` gives it.
    """
    words = ENGLISH
    site = show_text(document["site"]["name"] or document["site"]["file"])
    kind = words("winter_page.title")
    remarks = (show_text(note) for note in document["notes"])
    station = Part(
        id="station",
        blocks=(
            *(
                Paragraph(text=sentence)
                for sentence in _describe_station(document, words)
            ),
            notes(words("winter_page.chain"), words("winter_page.law"), *remarks),
        ),
    )
    blocks = (
        masthead("netdesign winter", words("show.label", label=kind, text=site)),
        station,
        *(
            section(
                f"row-{place}",
                name_row(show_text(row["id"]), words),
                *_show_row(row, document, words),
            )
            for place, row in enumerate(document["rows"], 1)
        ),
    )
    text = json.dumps(document, indent=1, allow_nan=False, ensure_ascii=False)
    return {
        DOCUMENT_FILE: text.encode(),
        PAGE_FILE: render_page(blocks, f"{site} - {kind}", "en").encode(),
    }


def _describe_station(document: Mapping[str, Any], words: Words) -> list[str]:
    """Sentences on where the heights come from, and how they reach the rows."""
    station = document["station"]
    altitude = station["altitude_m"]
    named = station["name"] or words("winter_page.unnamed")
    if altitude is not None:
        named = words("winter_page.at_altitude", station=named, altitude=altitude)
    if station["file"] != document["site"]["file"]:
        named = f"{named} ({station['file']})"
    sentences = [
        words(
            "winter_page.station",
            station=named,
            first=station["first_day"],
            last=station["last_day"],
        ),
        words("winter_page.model", model=document["model"]),
    ]
    if station["is_smoothed"]:
        sentences.append(words("winter_page.smoothed"))
    return [show_text(text) for text in sentences]


def _show_row(
    row: Mapping[str, Any], document: Mapping[str, Any], words: Words
) -> Iterator[Block]:
    shown = [winter for winter in row["winters"] if winter["curve"]]
    air = document["air_temperatures_C"]
    yield from _describe_row(row, words)
    yield _tabulate_winters(row, words).shown("study winters")
    if unproven := _list_unproven(row, words):
        yield notes(*unproven, look="notes open")
    for winter in shown:
        drawn = draw_winter(winter, air, words)
        yield Figure(svg=drawn, caption=_label(winter, words), look="plate")
        if failed := _list_failed(winter, words):
            yield notes(*failed)
    if row["measured"] or row["not_compared"]:
        yield Heading(text=words("winter_measured.heading"), level=3)
    for measured in row["measured"]:
        svg = draw_measured(measured, air, words)
        caption = _describe_measured(measured, words)
        yield Figure(svg=svg, caption=caption, look="plate")
    for text in row["not_compared"]:
        yield Paragraph(text=show_text(text), look="notes open")
    members = _tabulate_members(shown, words)
    if members.rows:
        yield members.shown("study winters")
    yield _tabulate_models(row, document["model"], words).shown("study winters")
    yield from _show_statistics(row, words)
    yield Heading(text=words("winter_page.density_heading"), level=3)
    for text in _describe_range(row, document, words):
        yield Paragraph(text=text)


def _describe_row(row: Mapping[str, Any], words: Words) -> list[Paragraph]:
    is_given = row["height_factor_given"]
    factor = "winter_page.factor_given" if is_given else "winter_page.factor_assumed"
    scene = words(
        "winter_page.scene",
        friction=row["friction_deg"],
        inclination=row["inclination_deg"],
        height=row["net_height_m"],
        slope=row["slope_deg"],
    )
    sentences = (scene, words(factor, factor=row["height_factor"]))
    return [Paragraph(text=text, look="small") for text in sentences]


def _label(winter: Mapping[str, Any], words: Words) -> str:
    return words("show.label", label=winter["name"], text=show_text(winter["why"]))


def _list_unproven(row: Mapping[str, Any], words: Words) -> list[str]:
    """Winters that may have the largest force, those of one reason together."""
    by_reason: dict[str, list[str]] = {}
    for winter in row["winters"]:
        if not (winter["is_proven"] or winter["is_below_largest"]):
            by_reason.setdefault(show_text(winter["why"]), []).append(winter["name"])
    return [
        words("show.label", label=", ".join(names), text=why)
        for why, names in by_reason.items()
    ]


def _describe_measured(entry: Mapping[str, Any], words: Words) -> str:
    """Distance of measured and computed forces, and what the band is."""
    sentences = [
        words(
            "winter_measured.caption",
            member=show_member(words, entry["member"]),
            winter=entry["winter"],
            source=show_text(entry["source"]),
        ),
        words("winter_measured.swing"),
    ]
    if entry["temperature_amplitude_assumed"]:
        sentences.append(words("winter_measured.assumed"))
    return " ".join(sentences)


def _tabulate_winters(row: Mapping[str, Any], words: Words) -> Table:
    keys = (
        *("winter", "height_max", "on", "swe_max", "foot", "head", "governing"),
        *("at_height_max", "uniform", "equivalent", "days_90", "outcome"),
    )
    numbers = [keys[k] for k in (1, 3, 4, 5, 7, 8, 9, 10)]
    rows = tuple(
        (
            _unbroken(winter["name"]),
            fixed_cell(words, winter["height_max_m"], 2),
            _unbroken(winter["height_max_date"]),
            fixed_cell(words, winter["swe_max_kg_m2"], 0),
            # none where no day has a force, though snow pulls
            *(
                force_cell(words, winter[f"{x}_peak_kN_per_m"])
                for x in ("foot", "head")
            ),
            _unbroken(winter["governing_date"] or MISSING),
            force_cell(words, winter["foot_at_height_max_kN_per_m"]),
            _show_uniform(winter, words),
            fixed_cell(words, winter["equivalent_density_kg_m3"], 0),
            fixed_cell(words, winter["days_above_90_percent"], 0),
            text_cell(words(f"winter_outcome.{_name_outcome(winter)}")),
        )
        for winter in row["winters"]
    )
    return Table(
        caption=words("winter_page.summary_caption"),
        columns=key_columns(words, "winter_column.", keys, numbers=numbers),
        rows=rows,
    )


def _show_uniform(winter: Mapping[str, Any], words: Words) -> Cell:
    """Annual maximum of uniform snow, or what it is at most."""
    bound = winter.get("uniform_at_most_kN_per_m")
    if bound is None:
        return force_cell(words, winter.get("uniform_peak_kN_per_m"))
    return text_cell(words("winter_page.at_most", bound=bound))


def _name_outcome(winter: Mapping[str, Any]) -> str:
    is_bounded = winter["uniform_at_most_kN_per_m"] is not None
    return "bounded" if is_bounded else str(winter["outcome"])


def _tabulate_members(shown: list[Mapping[str, Any]], words: Words) -> Table:
    """Largest characteristic force of each member, per support."""
    members = list(
        dict.fromkeys(m for winter in shown for m in winter["members_peak_kN"])
    )
    headings = [words("winter_column.winter")]
    headings += [show_member(words, member) + " [kN]" for member in members]
    return Table(
        caption=words("winter_page.members_caption"),
        columns=name_columns(headings, numbers=headings[1:]),
        rows=tuple(
            (
                _unbroken(winter["name"]),
                *(force_cell(words, winter["members_peak_kN"].get(m)) for m in members),
            )
            for winter in shown
            if members
        ),
    )


def _tabulate_models(row: Mapping[str, Any], model: str, words: Words) -> Table:
    """Annual maximum of uniform snow by each settling model."""
    others = list(
        dict.fromkeys(m for winter in row["winters"] for m in winter["models"])
    )
    names = [model, *others]
    headings = [words("winter_column.winter")]
    headings += [words("winter_page.pull_by", model=name) for name in names]
    headings += [words("winter_page.density_by", model=name) for name in names]
    rows = []
    for winter in row["winters"]:
        every = [winter, *(winter["models"].get(name, {}) for name in others)]
        rows.append(
            (
                _unbroken(winter["name"]),
                *(_show_uniform(part, words) for part in every),
                *(
                    fixed_cell(words, part.get("uniform_equivalent_density_kg_m3"), 0)
                    for part in every
                ),
            )
        )
    return Table(
        caption=words("winter_page.models_caption"),
        columns=name_columns(headings, numbers=headings[1:]),
        rows=tuple(rows),
    )


def _show_statistics(row: Mapping[str, Any], words: Words) -> Iterator[Block]:
    """Return values, winters that count by a bound or not at all."""
    statistics = row["statistics"]
    if statistics:
        yield _tabulate_statistics(statistics, words).shown("study")
    if remarks := [show_text(note) for note in row["statistics_notes"]]:
        yield notes(*remarks, look="notes open")
    yield from _compare_tails(statistics or {"return_values": ()}, words)
    if row["snow_heights"]:
        yield Paragraph(text=show_text(row["snow_heights"]))


def _tabulate_statistics(statistics: Mapping[str, Any], words: Words) -> Table:
    keys = ("period", "return_value", "interval", "error")
    is_limited = statistics["limit_kN_per_m"] is not None
    moments, limited = "winter_page.statistics_caption", "winter_page.limited_caption"
    return Table(
        caption=words(
            limited if is_limited else moments,
            count=statistics["winters"],
            mean=statistics["mean_kN_per_m"],
            variation=statistics["variation"],
        ),
        columns=key_columns(words, "winter_column.", keys, numbers=keys),
        rows=tuple(
            (
                fixed_cell(words, value["period_a"], 0),
                force_cell(words, value["foot_kN_per_m"]),
                _show_interval(value, words),
                force_cell(words, value["standard_error_kN_per_m"]),
            )
            for value in statistics["return_values"]
        ),
    )


def _show_interval(value: Mapping[str, Any], words: Words) -> Cell:
    ends = [value.get(f"{end}_kN_per_m") for end in ("low", "high")]
    return text_cell(words.show_band("max_kN", *ends))


def _compare_tails(statistics: Mapping[str, Any], words: Words) -> Iterator[Block]:
    """Sentences on what a heavier tail than Gumbel's would make of the values."""
    for value in statistics["return_values"]:
        if value["tails"]:
            light, heavy = value["tails"]
            sentence = words(
                "winter_page.tails",
                period=value["period_a"],
                light=light["foot_kN_per_m"],
                light_high=light["high_kN_per_m"],
                heavy=heavy["foot_kN_per_m"],
                heavy_high=heavy["high_kN_per_m"],
            )
            yield notes(sentence, look="notes open")


def _describe_range(
    row: Mapping[str, Any], document: Mapping[str, Any], words: Words
) -> list[str]:
    """Density range of the winters beside that of the check."""
    low, high = document["check_density_kg_m3"]
    sentences = [words("winter_page.check_range", low=low, high=high)]
    if row["equivalent_density"]:
        sentences.insert(0, show_text(row["equivalent_density"]["justification"]))
        sentences.append(words("winter_page.feed", sheet=document["ranges_sheet"]))
    return sentences


def _list_failed(winter: Mapping[str, Any], words: Words) -> list[str]:
    """Days without a force or without layers, those of one reason together."""
    by_reason: dict[tuple[str, str], list[str]] = {}
    for day in winter["curve"]:
        if day["outcome"] in ("failed", "overtopped") or day["reason"]:
            key = day["outcome"], day["reason"]
            by_reason.setdefault(key, []).append(day["date"])
    return [
        words(
            "winter_page.failed_day",
            count=len(dates),
            day=tuple(dates),
            outcome=_explain(words(f"day_outcome.{outcome}"), reason, words),
        )
        for (outcome, reason), dates in by_reason.items()
    ]


def _explain(outcome: str, reason: str, words: Words) -> str:
    """Outcome of a day, with its reason where it has one."""
    if not reason:
        return outcome
    return words("show.with_note", text=outcome, note=show_text(reason))


def _unbroken(text: str) -> Cell:
    """Date, or name of a winter, that stays on one line."""
    return text_cell(text.replace("-", "\u2011").replace("/", "\u2060/\u2060"))
