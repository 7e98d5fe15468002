"""One solution -> folder: page without script, drawings, history as CSV, JSON.

All numbers shown come from the solution document; the shapes from the solution.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from netdesign.coupling.face import find_face
from netdesign.coupling.moments import (
    LEAST_STRAIN,
    NODE_DRIFT,
    PULL_DRIFT,
    REST_SHARE,
    REST_WAY,
)
from netdesign.coupling.solution import FailedSolution, Solution, WallSolution
from netdesign.report.blocks import (
    SMALL,
    Block,
    Column,
    Figure,
    Pair,
    Pairs,
    Paragraph,
    Part,
    Piece,
    Table,
    key_columns,
    masthead,
    notes,
    number_cell,
    number_column,
    quantity_column,
    section,
    strong,
    text_cell,
    write_csv,
)
from netdesign.report.drawing.charts import Line, Mark, Panel, draw_panels
from netdesign.report.drawing.net_figures import (
    draw_meshes,
    draw_node_forces,
    draw_stick_slip,
    picture_mesh,
)
from netdesign.report.drawing.panel_figure import draw_panel
from netdesign.report.page.render import render_page
from netdesign.report.page.solved_support import show_support
from netdesign.report.words import (
    Words,
    show_text,
)
from netdesign.study.support_records import PanelRecord
from netdesign.words.catalogue import Language
from netdesign.words.names import name

Solved = Solution | WallSolution | FailedSolution
PAGE_FILE, SOLUTION_FILE, HISTORY_FILE = "index.html", "solution.json", "history.csv"

_DRAWINGS = ("history", "node_forces", "stick_slip", "mesh", "panel")


def list_solution_files(
    method: str, *, is_wall: bool, has_panel: bool = False
) -> list[str]:
    """Names of all files that a solution of this kind may become."""
    has_history = method != "steady" and not is_wall
    is_there = {"panel": has_panel, "history": has_history}
    drawings = [f"{name}.svg" for name in _DRAWINGS if is_there.get(name, True)]
    tables = [HISTORY_FILE] if has_history else []
    return [SOLUTION_FILE, PAGE_FILE, *drawings, *tables]


def render_solution(
    solution: Solved,
    document: dict[str, Any],
    scene_file: str,
    language: Language = "en",
    panel: PanelRecord | None = None,
) -> dict[str, bytes]:
    """Contents of all files of one solution, by name.

    Parameters
    ----------
    solution : Solution, WallSolution or FailedSolution
        Shapes to draw; a failed one has none.
    document : dict
        As ``solution_file.write_solution_document`` gives it.
    scene_file : str
        Name of the scene's file, for the page's title.
    language : str
        Of page and drawings; the tables of numbers keep their keys.
    panel : PanelRecord, optional
        The panel beside the net, to be drawn.
    """
    words = Words(language)
    drawings = (
        {} if isinstance(solution, FailedSolution) else _draw(solution, panel, words)
    )
    files = {
        SOLUTION_FILE: json.dumps(document, indent=1, allow_nan=False).encode(),
        PAGE_FILE: _render_page(document, drawings, scene_file, words).encode(),
        **{f"{name}.svg": svg.encode() for name, svg in drawings.items()},
    }
    if document.get("history"):
        files[HISTORY_FILE] = write_history(document["history"])
    return files


def write_history(moments: Sequence[dict[str, Any]]) -> bytes:
    """History of a solution document as CSV, one moment a line."""
    plain = [key for key in moments[0] if key != "node_forces"]
    count = len(moments[0]["node_forces"])
    nodes = [
        f"node_{k + 1}_{axis}_kN_per_m" for k in range(count) for axis in ("x", "y")
    ]
    rows = [
        [
            *(moment[key] for key in plain),
            *(part for node in moment["node_forces"] for part in node),
        ]
        for moment in moments
    ]
    return write_csv([*plain, *nodes], rows)


def _draw(
    solution: Solution | WallSolution, panel: PanelRecord | None, words: Words
) -> dict[str, str]:
    face = find_face(solution)
    svgs = {
        "history": _draw_history(solution, words)
        if isinstance(solution, Solution)
        else "",
        "node_forces": draw_node_forces(face, words),
        "stick_slip": draw_stick_slip(face, words),
        "mesh": draw_meshes([picture_mesh(solution, "")], words),
        "panel": draw_panel(panel, words) if panel else "",
    }
    return {name: svg for name, svg in svgs.items() if svg}


def _draw_history(solution: Solution, words: Words) -> str:
    history = solution.history
    if history is None:
        return ""
    times = [moment.time / 86_400.0 for moment in history.moments]
    pulls = {
        "foot": [_size(moment.foot) for moment in history.moments],
        "head": [_size(moment.head) for moment in history.moments],
    }
    begin = history.plateau.time
    marks = (
        []
        if begin is None
        else [Mark(x=begin / 86_400.0, label=words("solved.plateau_from"))]
    )
    lines = [
        Line(
            label=words(f"solved.{end}"),
            x=times,
            y=sizes,
            style=place,
            is_accent=end == "foot",
        )
        for place, (end, sizes) in enumerate(pulls.items())
    ]
    panel = Panel(
        title=words("solved.pull_title"), lines=lines, marks=marks, from_zero=True
    )
    return draw_panels(
        [panel],
        _describe_history(pulls, times, words),
        panel_pt=166.0,
        time_label=words("solved.time"),
        language=words.language,
    )


def _describe_history(
    pulls: dict[str, list[float]], times: Sequence[float], words: Words
) -> str:
    """Words for the chart: of each end the first pull, the largest and the last."""
    key = "foot_size_kN_per_m"
    values = tuple(
        words(
            "solved.history_of",
            pull=words(f"solved.pull_on_{end}"),
            first=words.show_with_unit(key, sizes[0]),
            largest=words.show_with_unit(key, max(sizes)),
            last=words.show_with_unit(key, sizes[-1]),
            days=words.write(f"{times[-1]:.3g}"),
        )
        for end, sizes in pulls.items()
    )
    what = words("solved.force_history")
    return words("drawing.with_values", what=what, values=values)


def _size(vector: Any) -> float:
    x, y = (float(part) for part in vector)
    return float((x * x + y * y) ** 0.5 / 1e3)


def _render_page(
    document: dict[str, Any], drawings: Mapping[str, str], scene_file: str, words: Words
) -> str:
    is_proven = document["outcome"] == "converged"
    title = show_text(scene_file)
    kind = words("solved.page")
    method = words(f"solved_method.{document['method']}") if is_proven else ""
    blocks: list[Block] = [masthead(f"{kind} · {method}" if method else kind, title)]
    if is_proven:
        blocks += _show_solution(document, drawings, words)
    else:
        outcome = words(f"ended.{document['outcome']}").replace("_", " ")
        failed = words("solved.no_result", outcome=outcome)
        blocks.append(_warn(failed, show_text(document.get("reason", ""))))
    return render_page(blocks, f"{title} - {kind}", words.language)


def _warn(what: str, why: str) -> Part:
    text = (*strong(what), Piece(f" {why}"))
    return Part(
        kind="div", id="outcome", look="notes open", blocks=(Paragraph(text=text),)
    )


def _show_solution(
    document: dict[str, Any], drawings: Mapping[str, str], words: Words
) -> list[Block]:
    plateau, flags = document.get("plateau"), document.get("flags", ())
    support = document.get("support")
    blocks: list[Block] = []
    if plateau is not None and not plateau["reached"]:
        blocks.append(_warn(words("solved.no_plateau"), words("solved.largest_so_far")))
    blocks.append(Pairs(look="numbers", pairs=tuple(_list_headlines(document, words))))
    axes = words("solved.axes")
    if plateau:
        axes += " " + words("solved.plateau", criterion=describe_criterion(words))
    blocks.append(Paragraph(text=axes, look="small"))
    if flags:
        blocks.append(notes(*(show_text(flag) for flag in flags)))
    if support:
        blocks.append(show_support(support, words))
    blocks += [
        Figure(
            svg=svg,
            caption=words(f"solved_caption.{name}"),
            id=f"figure-{name}",
            look="plate",
        )
        for name, svg in drawings.items()
    ]
    tables = (_tabulate_nodes(document, words), _tabulate_quality(document, words))
    numbers = [table.shown("study") for table in tables]
    return [*blocks, section("tables", words("solved.numbers"), *numbers)]


def describe_criterion(words: Words) -> str:
    """Criterion of a plateau, in words."""
    return words(
        "solved.criterion",
        strain=LEAST_STRAIN,
        pull=PULL_DRIFT,
        node=NODE_DRIFT,
        rest=REST_SHARE,
        way=REST_WAY,
    )


def _list_headlines(document: dict[str, Any], words: Words) -> list[Pair]:
    if document["wall"]:
        return _list_wall_headlines(document["wall"], words)
    plateau = document.get("plateau")
    shown = [_show_pull(document, end, words) for end in ("foot", "head")]
    key = "solved.normal_to_chord_end" if plateau else "solved.normal_to_chord"
    sag = words.show_number("sag_m", document["sag_m"])
    return [*shown, _headline(words("solved.sag"), sag, "m", words(key))]


def _list_wall_headlines(wall: dict[str, Any], words: Words) -> list[Pair]:
    error = words.show_number("error_kN_per_m", wall["error_kN_per_m"])
    note = words("solved.error", error=error)
    parts = (
        ("solved.force_along", "force_x_kN_per_m", "kN/m", note),
        ("solved.force_normal", "force_y_kN_per_m", "kN/m", note),
        ("solved.moment", "moment_about_foot_kN", "kN", ""),
    )
    return [
        _headline(words(name), _show_size(wall[key], words), unit, told)
        for name, key, unit, told in parts
    ]


def _show_pull(document: dict[str, Any], end: str, words: Words) -> Pair:
    """Pull on one end: its largest, and on the plateau of a history."""
    pull, plateau = document["anchor_forces"][end], document.get("plateau")
    error = words.show_number("error_kN_per_m", pull["error_kN_per_m"])
    note = words("solved.error", error=error)
    label = words("solved.pull_on_foot" if end == "foot" else "solved.pull_on_head")
    if plateau:
        label = words("solved.largest_of_scene", pull=label)
    if plateau and plateau["reached"]:
        size = words.show_number("foot_size_kN_per_m", plateau[f"{end}_kN_per_m"])
        note = words("solved.on_plateau", note=note, size=size)
    size = _show_size(pull["size_kN_per_m"], words)
    return _headline(label, size, "kN/m", note)


def _show_size(value: float, words: Words) -> str:
    return words.show_number("foot_size_kN_per_m", value)


def _headline(label: str, value: str, unit: str, note: str) -> Pair:
    """Number that the page opens with."""
    text = (Piece(f"{value} ", "value"), Piece(unit, "unit"), Piece(note, SMALL))
    return Pair(name=label, text=text)


def _tabulate_nodes(document: dict[str, Any], words: Words) -> Table:
    columns: tuple[Column, ...] = (
        Column(heading=words("solved.node"), is_number=True),
        number_column("sag_m", "x [m]"),
        number_column("sag_m", "y [m]"),
        quantity_column(words, "force_x_kN_per_m"),
        quantity_column(words, "force_y_kN_per_m"),
        Column(heading=words("solved.snow")),
    )
    rows = tuple(
        (
            text_cell(str(place)),
            number_cell(words, "sag_m", node["x_m"]),
            number_cell(words, "sag_m", node["y_m"]),
            number_cell(words, "force_x_kN_per_m", node["force_x_kN_per_m"]),
            number_cell(words, "force_y_kN_per_m", node["force_y_kN_per_m"]),
            text_cell(words("solved.slips" if node["sliding"] else "solved.sticks")),
        )
        for place, node in enumerate(document["nodes"])
    )
    return Table(
        caption=words("solved.nodes_caption"),
        columns=columns,
        rows=rows,
    )


def _tabulate_quality(document: dict[str, Any], words: Words) -> Table:
    balance, cost = document["balance"], document["cost"]
    pairs = {
        "solved.weight": words.show_with_unit(
            "foot_size_kN_per_m", balance["weight_along_slope_kN_per_m"]
        ),
        "solved.missing": words.show_number(
            "balance_residual", balance["relative_residual"]
        ),
        "solved.ground_tension": words.show_number(
            "utilisation", balance["ground_tension_share"]
        ),
        "solved.suction": words.show_number("utilisation", balance["suction_share"]),
        "solved.triangles": words.show_given(cost["elements"]),
        "solved.linear_solves": words.show_given(cost["linear_solves"]),
        "solved.creep_law": document["provenance"]["creep_law"],
        "solved.settings": words.join(
            f"{words.show(name('setting', key))} {_show_setting(key, value, words)}"
            for key, value in document["provenance"]["settings"].items()
        ),
        "solved.program": f"netdesign {document['provenance']['version']}",
    }
    rows = tuple(
        (text_cell(words(key)), text_cell(value)) for key, value in pairs.items()
    )
    return Table(
        caption=words("solved.quality_caption"),
        columns=key_columns(words, "", ("solved.quantity", "solved.value")),
        rows=rows,
    )


def _show_setting(key: str, value: Any, words: Words) -> str:
    """Setting of a run: a number, a truth value, or the start by its name."""
    if isinstance(value, bool):
        return words("show.yes" if value else "show.no")
    if isinstance(value, str):
        return words.show(name(key, value))
    return words.show_given(value)
