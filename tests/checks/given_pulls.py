"""A net row from a workbook, judged under given pulls of the net, without a solve."""

import math
from dataclasses import replace
from pathlib import Path

import openpyxl

from netdesign.checks import Band, load_standard
from netdesign.coupling.scene import SolverSettings
from netdesign.envelope.run import CaseResult
from netdesign.outcome import Outcome
from netdesign.site.reader import read_site
from netdesign.structure.anchors import compute_anchor_forces
from netdesign.structure.layout import place_support
from netdesign.structure.members import NetPart
from netdesign.study.judge import judge_site
from netdesign.study.row_to_check import CheckRun
from tests.grid import build_cases, wrap_results


def find_second(gap):
    """Load beside an end over that inside, (S10a); it stands for all of its types.

    N = 1.2, bays of 3.5 m: f_R = (0.92 + 0.65 * 1.2) A / 2 over 0.6 A / 2.
    """
    return 1.0 + 0.85 * gap * (0.3 * gap) ** 2 / (2.0 * 3.5**2)


NETS = {
    "id": "R",
    "slope angle [deg]": 35,
    "snow thickness [m]": 2.8,
    "upslope length [m]": 18,
    "ground law": "no-slip",
    "net height [m]": 3.0,
    "net stiffness [kN/m]": 10000,
    "post spacing [m]": 3.5,
    "number of posts": 12,
    "post tilt [deg]": 15,
    "uphill anchor distance [m]": 3.0,
    "downhill anchor distance [m]": 3.0,
    "foot anchor": "A",
    "uphill anchor": "A",
    "downhill anchor": "A",
    "uphill guy": "G",
    "downhill guy": "G",
    "post": "P",
    "guys on each side of the post": 2,
    "splay of the guys [deg]": 30,
    "slack [-]": 0.05,
    "layers of the snow": "uniform",
    "panel system": "none",
    "axes of the anchors": "along the pull",
    "anchors of the guys": "own",
    "ground of the anchors": "till",
    "design life in years": 50,
    "distance to the next edge [m]": 20,
    "mesh strength [kN/m]": 300,
}
AXES = ("foot anchor axis", "uphill anchor axis", "downhill anchor axis")
ROPE = {
    "id": "G",
    "rope diameter [mm]": 20,
    "construction": "6x36-IWRC",
    "rope grade [MPa]": 1770,
    "termination": "clips",
    "protected for years": 60,
}
POST = {
    "id": "P",
    "section area [cm2]": 34.0,
    "second moment of area [cm4]": 318.0,
    "buckling length [m]": 3.1,
    "yield strength [MPa]": 235,
    "buckling curve": "c",
    "plate length [m]": 0.6,
    "plate width [m]": 0.5,
    "bearing stress [kPa]": 2000,
    "post width [mm]": 120,
    "section modulus [cm3]": 144,
    "eccentricity at the head [mm]": 0,
    "eccentricity at the foot [mm]": 0,
    "efficiency factor η": 1,
    "friction of the base": 0.6,
}


OF_ANCHOR = {  # where and how long it holds, unless a test says so itself
    "ground": "till",
    "corrosion protection": "cover",
    "protected for years": 100,
    "drilled length [m]": 5.5,
    "least cover of the bond [m]": 0.5,
    "least distance to an edge [m]": 2.0,
}


def judge_row(tmp_path: Path, profile, **changes):
    """Checks of the row by their ids, with these pulls of the net [kN/m]."""
    row = study_row(tmp_path, profile, **changes).rows[0]
    return {check.id: check for check in row.checks}


def study_row(
    tmp_path: Path,
    profile,
    *,
    anchor,
    foot,
    head,
    floor="none",
    post=POST,
    tests=(),
    **nets,
):
    """Study of the row under a profile, given by its id or its folder.

    Without a floor by the guideline's load the given pulls are the demand.
    """
    path = write_row(tmp_path, anchor=anchor, post=post, tests=tests, **nets)
    site = read_site(path)
    result = give_pulls(site, foot, head)
    run = CheckRun(settings=SolverSettings())
    standard = replace(load_standard(profile), floor=floor)
    return judge_site(
        site, [wrap_results(site, site.rows[0], [result], run)], standard, run
    )


def write_row(
    tmp_path: Path, *, anchor, post=POST, tests=(), foot=None, head=None, **nets
):
    """Workbook of the row; pulls are none of its cells. ``tests``: force and result."""
    line = NETS | {key.replace("_", " "): v for key, v in nets.items()}
    line |= {"ground of the anchors": anchor.get("ground", "till")}
    if any(key.startswith(AXES) for key in line):
        del line["axes of the anchors"]
    sheets = {
        "Nets": line,
        "Anchors": {"id": "A"} | OF_ANCHOR | anchor,
        "Ropes": ROPE,
        "Posts": post,
        "Ends": {"row": "R", "types of the support": "as inside"},
    }
    workbook = openpyxl.Workbook()
    workbook.remove(workbook.active)
    for name, line in sheets.items():
        sheet = workbook.create_sheet(name)
        sheet.append(list(line))
        sheet.append(list(line.values()))
    links = workbook.create_sheet("Links")
    links.append(["type", "link", "strength of the link [kN]", "chain"])
    for kind in ("A", ROPE["id"]):
        links.append([kind, "eye", 900, "complete"])
    if tests:
        sheet = workbook.create_sheet("Tests")
        headings = ("pull-out force [kN]", "outcome of the test")
        headings = ("anchor type", "ground", *headings, "planned proof load [kN]")
        sheet.append(headings)
        for line in tests:
            sheet.append(["A", anchor.get("ground", "till"), *line])
    ranges = workbook.create_sheet("Ranges")
    for line in (
        ["quantity", "low", "high"],
        ["density [kg/m3]", 380, 380],
        ["friction angle [deg]", 30, 30],
        ["net inclination [deg]", 30, 30],
    ):
        ranges.append(line)
    path = tmp_path / "site.xlsx"
    workbook.save(path)
    return path


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
        member_forces={
            member: Band(low=force, value=force, high=force)
            for member, force in {
                **anchors.member_forces,
                NetPart.MESH: 1e3 * max(math.hypot(*foot), math.hypot(*head)),
            }.items()
        },
        anchors=anchors,
    )
