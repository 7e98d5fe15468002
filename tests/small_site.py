"""A small sound site, built in code: what a test is about, it changes itself."""

import math

from netdesign.coupling.scene import MESH_LEVELS, SolverSettings
from netdesign.envelope.ranges import Interval, Ranges
from netdesign.resistance.ground import AnchorType
from netdesign.resistance.steel import Link, Wear
from netdesign.site.model import InputEcho, NetRow, Project, Resistance, Site
from netdesign.snow.ground import GroundLaw
from netdesign.structure.layout import SupportLayout
from netdesign.structure.members import (
    CONNECTED,
    DEPENDENT_MODES,
    END_ANCHORS,
    END_MODES,
    MEMBER_MODES,
    NET_MODES,
)
from netdesign.structure.splay import Guys
from netdesign.study.anchor_pulls import ANCHORS
from netdesign.study.row_to_check import CheckRun
from netdesign.words.catalogue import as_given
from netdesign.words.message import say

STRONG, WEAK = 1e7, 1e3  # [N]
TURNS = AnchorType(
    kind="rope anchor",
    section=None,
    lever=None,
    drilled=6.0,
    across=1e7,
)
LASTS = Wear(kind="rope")
EYE = Link(
    kind="eye",
    breaking=1e8,
    limit=None,
    count=1,
    angle=None,
    source="Links!C2",
    is_of_whole=True,
)
RUN = CheckRun(
    settings=SolverSettings(accuracy=0.1, levels=MESH_LEVELS[:2]),
    started="2026-01-02T03:04:05+00:00",
)
RANGES = Ranges.of(
    density=Interval(low=270.0, high=400.0),
    friction_angle=Interval(low=math.radians(15), high=math.radians(45)),
    inclination=Interval(low=math.radians(30), high=math.radians(30)),
)


def resist(value=STRONG, **special):
    """Resistances of all members; ``special`` maps ``member__mode`` to a value."""
    of_forces = tuple(
        Resistance(
            member=member,
            mode=mode,
            value=special.get(f"{member}__{mode}", value),
            basis="tested" if mode == "pull_out" else "",
            type_id="T1",
            source="Anchors!B2",
            ground="till",
            wear=LASTS if mode in ("tendon", "rope") else None,
        )
        for member, mode in (*MEMBER_MODES, *DEPENDENT_MODES)
    )
    return (*of_forces, *turn(ANCHORS))


def turn(anchors):
    """Resistances of rope anchors that turn to their pull, with a head of theirs."""
    return tuple(
        Resistance(
            member=one,
            mode="direction",
            type_id="T1",
            source="Anchors!B2",
            dimensions=TURNS,
        )
        for one in anchors
    )


def name_directions(*, has_end=False):
    """Ids of the checks of directions on a row with an end, in their order."""
    at_end = [*ANCHORS, *(END_ANCHORS if has_end else ())]
    names = [f"{one}.direction" for one in ANCHORS]
    return [*names, *(f"{one}.direction.end" for one in at_end)]


def name_force_checks(*, has_ropes=False, has_end=False):
    """Ids of all checks of a force on a row with an end, in their order."""
    inside = _add_chains((*MEMBER_MODES, *DEPENDENT_MODES))
    beside = _add_chains(NET_MODES if has_ropes else NET_MODES[:1])
    beside += _add_chains(END_MODES if has_end else ())
    return [*inside, *(f"{one}.end" for one in (*inside, *beside))]


def _add_chains(modes):
    """Ids by member and mode, that of its links behind a rope's."""
    found = []
    for member, mode in modes:
        found.append(f"{member}.{mode}")
        if mode in ("tendon", "rope") and member in CONNECTED:
            found.append(f"{member}.connection")
    return found


def list_net_parts(value=STRONG, *, has_ropes):
    """Resistances of the mesh, and of border ropes where there are some."""
    return tuple(
        Resistance(
            member=part,
            mode=mode,
            value=value,
            basis="declared",
            type_id="B22",
            source="Ropes!B4",
            wear=LASTS if mode == "rope" else None,
        )
        for part, mode in (NET_MODES if has_ropes else NET_MODES[:1])
    )


def build_row(name, **changes):
    """Two and a half metres of snow on free ground, behind a net as high."""
    values = {
        "id": name,
        "slope_angle": math.radians(38.0),
        "snow_thickness": 2.5,
        "upslope_length": 6.0,
        "ground": GroundLaw(kind="free"),
        "net_height": 2.5,
        "net_stiffness_per_m": 8e6,
        "slack": 0.05,
        "altitude": 1417.0,
        "post_count": 20,
        "layout": SupportLayout(
            post_spacing=3.5, uphill_anchor_distance=3.0, downhill_anchor_distance=3.0
        ),
        "guys": Guys(count=2, splay=math.radians(29.0), are_shared=True),
        "has_row_above": False,
        "design_life": 50,
        "resistances": resist(),
        "net_parts": list_net_parts(has_ropes=bool(changes.get("panels"))),
        "ground_type": "till",
        "anchors": tuple((anchor, TURNS) for anchor in ANCHORS),
        "inputs": (
            InputEcho(
                label=say("column.Nets.slack"),
                unit="-",
                text="",
                value=0.05,
                cell="default",
            ),
        ),
    }
    return NetRow(**(values | changes))


def build_site(*rows, **changes):
    values = {
        "project": Project(name="Combe"),
        "ranges": RANGES,
        "rows": rows,
        "links": dict.fromkeys(("T1", "T2", "B22"), (EYE,)),
        "file_name": "site.xlsx",
        "sha256": "0" * 64,
        "notes": (as_given("column X was not read"),),
    }
    return Site(**(values | changes))


ROWS = (build_row("R1"), build_row("R2", ground=GroundLaw(kind="no-slip")))
