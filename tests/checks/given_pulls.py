"""A net row from a workbook, judged under given pulls of the net, without a solve."""

import math
from dataclasses import replace

import numpy as np

from netdesign.checks import Band, load_standard
from netdesign.coupling.scene import SolverSettings
from netdesign.coupling.solution import Balance, EndPull, SolvedState
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Outcome
from netdesign.site.columns.office import load_columns
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.layout import place_support
from netdesign.structure.members import Member, NetPart
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun
from tests.grid import build_cases, wrap_results
from tests.make import load_tables, read_tables


def find_second(gap):
    """Load beside an end over that inside, (S10a); it stands for all of its types.

    N = 1.2, bays of 3.5 m: f_R = (0.92 + 0.65 * 1.2) A / 2 over 0.6 A / 2.
    """
    return 1.0 + 0.85 * gap * (0.3 * gap) ** 2 / (2.0 * 3.5**2)


GIVEN = load_tables("given_row")
(ROW,), (NET,), (ANCHOR,) = (GIVEN[x] for x in ("rows", "net_types", "anchor_types"))
(ROPE,), (POST,) = GIVEN["ropes"], GIVEN["posts"]


def judge_row(profile, **changes):
    """Checks of the row by their ids, with these pulls of the net [kN/m]."""
    row = study_row(profile, **changes).rows[0]
    return {check.id: check for check in row.checks}


def study_row(profile, *, anchor, foot, head, floor="none", **row):
    """Study of the row under a profile, given by its id or its folder.

    Without a floor by the guideline's load the given pulls are the demand.
    """
    site = read_row(anchor=anchor, **row)
    result = give_pulls(site, foot, head)
    run = CheckRun(settings=SolverSettings())
    standard = replace(load_standard(profile), floor=floor)
    standard = set_efficiency(standard, row.get("post", POST).get("eta", 1.0))
    return judge_site(
        site, [wrap_results(site, site.rows[0], [result], run)], standard, run
    )


def read_row(*, anchor, post=POST, tests=(), **row):
    """Site of the row; what no cell says is set, above all that it has no panel.

    Of ``row`` the axes of anchors [deg]; the profile has the efficiency of ``post``.
    """
    axes = {key: row.pop(key) for key in AXES if key in row}
    bare = {key: value for key, value in post.items() if key != "eta"}
    site = read_tables(build_tables(anchor=anchor, post=bare, tests=tests, **row))
    (given,) = site.rows
    changed = {
        "axes": tuple((AXES[key], math.radians(angle)) for key, angle in axes.items())
        or given.axes,
        "panels": (),
        "row_end": None,
        "net_parts": given.net_parts[:1],
        "assumed": tuple(x for x in given.assumed if x.key in TOLD),
    }
    links = {
        name: tuple(replace(one, is_of_whole=True) for one in chain)
        for name, chain in site.links.items()
    }
    return replace(site, rows=(replace(given, **changed),), links=links)


TOLD = ("anchor_axes", "kind", "lever_arm", "efficiency")  # of what is assumed
AXES = {
    "foot_axis": Member.FOOT_ANCHOR,
    "uphill_axis": Member.UPHILL_ANCHOR,
    "downhill_axis": Member.DOWNHILL_ANCHOR,
}


def set_efficiency(standard, eta):
    """Profile by which snow presses on so many times a post's width; None: its own."""
    if eta is None:
        return standard
    fixed = {"post.efficiency": eta, "post.efficiency.per_glide": 0.0}
    values = (replace(x, value=fixed.get(x.id, x.value)) for x in standard.values)
    return replace(standard, values=tuple(values))


def build_tables(*, anchor, post=POST, tests=(), **row):
    """Tables of the row. ``tests``: force, result and planned load."""
    kind = dict(anchor)
    if "strength" in kind:  # [MPa], of a bar
        area = math.pi / 4.0 * kind["bar_diameter"] ** 2
        kind["tendon"] = kind.pop("strength") * area / 1e3
        if kind.get("kind") == "rope anchor":
            del kind["bar_diameter"]  # a bar's alone
    if "test_count" in kind:
        kind["proven"] = "tests"
    kind = ANCHOR | kind
    own = {one.field.key for one in load_columns("rows")}
    of_row = {key: value for key, value in row.items() if key in own}
    of_net = {key: value for key, value in row.items() if key not in own}
    post = dict(post)
    project = {"base_friction": post.pop("base_friction", None)}
    keys = ("force", "result", "proof_load")
    of_test = {"type": "A", "ground": kind["ground"]}
    link = {"link": "eye", "force": 900, "meaning": "strength"}
    return {
        "project": [GIVEN["project"][0] | project],
        "rows": [ROW | {"ground": kind["ground"]} | of_row],
        "net_types": [NET | of_net | {"post": post["id"]}],
        "anchor_types": [kind],
        "ropes": [ROPE],
        "posts": [post],
        "links": [{"type": one} | link for one in ("A", "G")],
        "tests": [of_test | dict(zip(keys, one, strict=False)) for one in tests],
    }


def give_pulls(site, foot, head) -> CaseResult:
    """Result of the only case, without a solve: the pulls are given."""
    (row,), (case,) = site.rows, build_cases(site.ranges)
    point = (row.net_height * math.tan(case.inclination), row.net_height)
    anchors = compute_anchor_forces(
        place_support(row.layout, point),
        foot_pull_per_m=(1e3 * foot[0], 1e3 * foot[1]),
        head_pull_per_m=(1e3 * head[0], 1e3 * head[1]),
        post_spacing=row.layout.post_spacing,
    )
    return CaseResult(
        case=case,
        outcome=Outcome.CONVERGED,
        solution=hang_net(point, foot, head),
        member_forces={
            member: Band(low=force, value=force, high=force)
            for member, force in {
                **anchors.member_forces,
                NetPart.MESH: 1e3 * max(math.hypot(*foot), math.hypot(*head)),
            }.items()
        },
        anchors=anchors,
    )


def hang_net(point, foot, head):
    """State of a net that leaves both ends along these pulls [kN/m]."""
    ends = [EndPull(x=1e3 * x, y=1e3 * y, error=0.0) for x, y in (foot, head)]
    sizes = [end.size for end in ends]
    ways = [np.array([end.x, end.y]) / end.size for end in ends]
    starts = [step * ways[0] for step in (0.0, 0.05, 0.1)]
    stops = [point + step * ways[1] for step in (0.1, 0.05, 0.0)]
    middle = (starts[-1] + stops[0]) / 2.0
    curve = np.array([*starts, middle, *stops]).T
    pressed = np.zeros_like(curve)
    return SolvedState(
        method="steady",
        foot=ends[0],
        head=ends[1],
        tension_max=max(sizes),
        net_curve=curve,
        net_forces=pressed,
        net_slides=np.zeros(curve.shape[1], dtype=bool),
        balance=Balance(
            weight_along_slope=1.0,
            relative_residual=0.0,
            friction_excess=0.0,
            smallest_tension=min(sizes),
            suction_share=0.0,
            ground_tension_share=0.0,
        ),
        cost=None,
    )
