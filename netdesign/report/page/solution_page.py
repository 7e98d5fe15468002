"""One solution -> folder: page without script, drawings, history as CSV, JSON.

All numbers shown come from the solution document; the shapes from the solution.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from netdesign.coupling.solution import FailedSolution, Solution, WallSolution
from netdesign.report.drawing.charts import Line, Mark, Panel, draw_panels
from netdesign.report.drawing.net_figures import (
    draw_meshes,
    draw_node_forces,
    draw_stick_slip,
    find_face,
    picture_mesh,
)
from netdesign.report.page.csv_text import write_csv
from netdesign.report.page.render import build_environment, load_style, mark_safe
from netdesign.report.view.table import (
    Column,
    Table,
    name_columns,
    number_cell,
    number_column,
    quantity_column,
    text_cell,
)
from netdesign.report.words import (
    ENGLISH,
    show_given,
    show_number,
    show_text,
    show_with_unit,
)

Solved = Solution | WallSolution | FailedSolution
PAGE_FILE, SOLUTION_FILE, HISTORY_FILE = "index.html", "solution.json", "history.csv"

_CAPTIONS = {
    "history": "Pull on the net's ends against time. The scale of time is logarithmic: "
    "a plateau is a slow drift, and looks level here.",
    "node_forces": "What the snow does, from the foot upwards. Left to scale; right "
    "per square metre, without the end nodes, where pressure has no bound.",
    "stick_slip": "Where the shear reaches p tan φ the snow slips.",
    "mesh": "Snow mesh with its density; in red what holds it.",
}
_METHODS = {
    "steady": "steady state",
    "transient": "history, implicit",
    "staggered": "history, the source paper's staggered exchange",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawn:
    """One drawing of the page, and the name of its file."""

    name: str
    caption: str
    svg: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Headline:
    """A number that the page opens with."""

    label: str
    value: str
    unit: str
    note: str


def list_solution_files(method: str, *, is_wall: bool) -> list[str]:
    """Names of all files that a solution of this kind may become."""
    drawings = [f"{name}.svg" for name in _CAPTIONS]
    names = [SOLUTION_FILE, PAGE_FILE, *drawings]
    if method == "steady" or is_wall:
        names.remove("history.svg")
        return names
    return [*names, HISTORY_FILE]


def render_solution(
    solution: Solved, document: dict[str, Any], scene_file: str
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
    """
    drawings = [] if isinstance(solution, FailedSolution) else _draw(solution)
    files = {
        SOLUTION_FILE: json.dumps(document, indent=1, allow_nan=False).encode(),
        PAGE_FILE: _render_page(document, drawings, scene_file).encode(),
        **{f"{drawn.name}.svg": drawn.svg.encode() for drawn in drawings},
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


def _draw(solution: Solution | WallSolution) -> list[Drawn]:
    face = find_face(solution)
    svgs = {
        "history": _draw_history(solution) if isinstance(solution, Solution) else "",
        "node_forces": draw_node_forces(face, "forces"),
        "stick_slip": draw_stick_slip(face, "stick"),
        "mesh": draw_meshes([picture_mesh(solution, "")], "mesh"),
    }
    return [
        Drawn(name=name, caption=_CAPTIONS[name], svg=svg)
        for name, svg in svgs.items()
        if svg
    ]


def _draw_history(solution: Solution) -> str:
    history = solution.history
    if history is None:
        return ""
    times = [moment.time / 86_400.0 for moment in history.moments]
    pulls = {
        "foot": [_size(moment.foot) for moment in history.moments],
        "head": [_size(moment.head) for moment in history.moments],
    }
    begin = history.plateau.time
    marks = [] if begin is None else [Mark(x=begin / 86_400.0, label="plateau from")]
    lines = [
        Line(label=end, x=times, y=sizes, style=place, is_accent=end == "foot")
        for place, (end, sizes) in enumerate(pulls.items())
    ]
    panel = Panel(
        title="Pull on foot and head [kN/m]", lines=lines, marks=marks, from_zero=True
    )
    return draw_panels([panel], "history", "Force history", panel_in=2.3)


def _size(vector: Any) -> float:
    x, y = (float(part) for part in vector)
    return float((x * x + y * y) ** 0.5 / 1e3)


def _render_page(
    document: dict[str, Any], drawings: Sequence[Drawn], scene_file: str
) -> str:
    proven = document["outcome"] == "converged"
    plateau = document.get("plateau")
    without_plateau = plateau is not None and not plateau["reached"]
    template = build_environment().get_template("solution.html")
    return template.render(
        css=load_style("report.css", "study.css"),
        title=show_text(scene_file),
        method=_METHODS[document["method"]] if proven else "",
        headline=_list_headlines(document) if proven else [],
        without_plateau=without_plateau,
        outcome=document["outcome"].replace("_", " "),
        reason=show_text(document.get("reason", "")),
        flags=[
            show_text(flag)
            for flag in document.get("flags", ())
            if not flag.startswith("no plateau")  # the page opens with it
        ],
        criterion=plateau["criterion"] if plateau else "",
        figures=[
            {"caption": drawn.caption, "svg": mark_safe(drawn.svg), "name": drawn.name}
            for drawn in drawings
        ],
        tables=[_tabulate_nodes(document), _tabulate_quality(document)]
        if proven
        else [],
    )


def _list_headlines(document: dict[str, Any]) -> list[Headline]:
    if document["wall"]:
        wall = document["wall"]
        error = show_number("error_kN_per_m", wall["error_kN_per_m"])
        return [
            _headline("Force along the slope", wall["force_x_kN_per_m"], f"± {error}"),
            _headline("Force normal to it", wall["force_y_kN_per_m"], f"± {error}"),
            _headline(
                "Moment about the foot", wall["moment_about_foot_kN"], "", unit="kN"
            ),
        ]
    plateau = document.get("plateau")
    shown = []
    for end in ("foot", "head"):
        pull = document["anchor_forces"][end]
        note = f"± {show_number('error_kN_per_m', pull['error_kN_per_m'])}"
        if plateau and plateau["reached"]:
            at_rest = plateau[f"{end}_kN_per_m"]
            note = (
                f"{note}; {show_number('foot_size_kN_per_m', at_rest)} on the plateau"
            )
        label = f"Pull on the {end}" + (
            ", largest while the snow is the scene's" if plateau else ""
        )
        shown.append(_headline(label, pull["size_kN_per_m"], note))
    sag = Headline(
        label="Sag of the net",
        value=show_number("sag_m", document["sag_m"]),
        unit="m",
        note="normal to its chord" + ("; at the end" if plateau else ""),
    )
    return [*shown, sag]


def _headline(label: str, value: float, note: str, unit: str = "kN/m") -> Headline:
    shown = show_number("foot_size_kN_per_m", value)
    return Headline(label=label, value=shown, unit=unit, note=note)


def _tabulate_nodes(document: dict[str, Any]) -> Table:
    columns: tuple[Column, ...] = (
        Column(heading="Node", is_number=True),
        number_column("sag_m", "x [m]"),
        number_column("sag_m", "y [m]"),
        quantity_column(ENGLISH, "force_x_kN_per_m"),
        quantity_column(ENGLISH, "force_y_kN_per_m"),
        Column(heading="Snow"),
    )
    rows = tuple(
        (
            text_cell(str(place)),
            number_cell("sag_m", node["x_m"]),
            number_cell("sag_m", node["y_m"]),
            number_cell("force_x_kN_per_m", node["force_x_kN_per_m"]),
            number_cell("force_y_kN_per_m", node["force_y_kN_per_m"]),
            text_cell("slips" if node["sliding"] else "sticks"),
        )
        for place, node in enumerate(document["nodes"])
    )
    return Table(
        caption="Nodes from the foot upwards, and what the snow does to them",
        columns=columns,
        rows=rows,
    )


def _tabulate_quality(document: dict[str, Any]) -> Table:
    balance, cost = document["balance"], document["cost"]
    pairs = {
        "Weight along the slope": show_with_unit(
            "foot_size_kN_per_m", balance["weight_along_slope_kN_per_m"]
        ),
        "Force missing from the balance, over the weight": show_number(
            "balance_residual", balance["relative_residual"]
        ),
        "Share of the ground's normal force that is tension": show_number(
            "utilisation", balance["ground_tension_share"]
        ),
        "Share of the normal force that is suction": show_number(
            "utilisation", balance["suction_share"]
        ),
        "Triangles, finest mesh": show_given(cost["elements"]),
        "Linear solves": show_given(cost["linear_solves"]),
        "Creep law": document["provenance"]["creep_law"],
        "Settings": ", ".join(
            f"{key.replace('_', ' ')} {value}"
            for key, value in document["provenance"]["settings"].items()
        ),
        "Program": f"netdesign {document['provenance']['version']}",
    }
    rows = tuple((text_cell(key), text_cell(value)) for key, value in pairs.items())
    return Table(
        caption="Balance, cost, provenance",
        columns=name_columns(("Quantity", "Value"), numbers=()),
        rows=rows,
    )
