"""A site of drawn numbers, unlike the example in whatever the page may show."""

import random

from tests.old_example import write_old_example

PROFILE = "eurocode"
_END_OF_U1 = {
    "row": "U1",
    "foot_anchor": "strong",
    "uphill_anchor": "drilled",
    "downhill_anchor": "drilled",
    "uphill_guy": "guy",
    "downhill_guy": "number",
    "post": "slim",
}


def write_untidy_site(path, seed):
    """Three net rows: floor and bent bar, shared anchor, loaded downhill guy."""
    write_old_example(path, lines=draw_site(random.Random(seed)))


def draw_site(draw):
    def vary(value, digits=3):
        return float(f"{value * draw.uniform(0.97, 1.03):.{digits}g}")

    lines = {
        "Project": [
            {"item": "name", "value": "Drawn slope"},
            {"item": "author", "value": "A. Nobody"},
            {"item": "extrapolated creep law accepted", "value": "boutillier-2004"},
        ],
        "Ranges": [
            _range("density", "kg/m3", vary(212.0), vary(277.0)),
            _range("friction angle", "deg", vary(17.3), vary(38.9)),
            _range("net inclination", "deg", vary(26.7), vary(32.6)),
            _range("slack", "-", vary(0.034), vary(0.061)),
        ],
        "Anchors": list(_list_anchors(vary)),
        "Ropes": list(_list_ropes(vary)),
        "Posts": list(_list_posts(vary)),
        "Nets": list(_list_nets(vary)),
        "Ends": [_END_OF_U1, {"row": "U2", "support_types": "as inside"}],
        "Declared": [
            {
                "row": "U1",
                "check": "Post base, sliding",
                "document": "Report 17",
                "author": "B. Nobody",
                "date": "2026-02-03",
            }
        ],
    }
    _complete_chain(lines, vary)
    return lines


def _complete_chain(lines, vary):
    """Mesh, links, steel over its life, and ground around the anchors."""
    for number, net in enumerate(lines["Nets"]):
        net["ground"] = "sandstone"
        net["mesh_strength"] = vary(231.0)
        net["design_life"] = 67
        net["edge_distance"] = vary(17.3)
        if net["guy_count"] == 2:
            net["guy_anchors"] = ("shared", "own")[number % 2]
    for kind in lines["Anchors"]:
        kind.setdefault("ground", "sandstone")
        kind["drilled_length"] = vary(7.3)
        kind["least_edge"] = vary(2.7)
        if kind["kind"] == "bar":
            kind |= {"soil_cohesion": vary(23.0), "soil_friction": vary(34.0)}
            kind["soil_weight"] = vary(20.7)
        else:
            kind["least_cover"] = vary(0.9)
        if kind["kind"] == "rope anchor":
            kind |= {"protection": "sheath", "protected_years": 83}
        else:
            kind |= {"protection": "sacrificial", "soil": "fill"}
    for rope in lines["Ropes"]:
        rope["protected_years"] = 71
    lines["Links"] = [
        {"type": "drilled", "link": "eye", "strength": vary(371.0)},
        {"type": "bent", "link": "shackle", "working_limit": vary(133.0), "count": 2},
        {"type": "guy", "link": "shackle", "strength": vary(310.0)},
        {"type": "guy", "link": "thimble", "working_limit": vary(97.0)},
        {"type": "number", "link": "turnbuckle", "strength": vary(287.0)},
        {"type": "strong", "link": "plate", "strength": vary(613.0)},
    ]
    for link in lines["Links"]:
        link["chain"] = "complete"


def _range(quantity, unit, low, high):
    return {"quantity": quantity, "unit": unit, "low": low, "high": high}


def _list_anchors(vary):
    yield {
        "id": "bent",
        "kind": "micropile",
        "bar_diameter": vary(51.0),
        "inner_diameter": vary(28.0),
        "bar_strength": vary(540.0),
        "lever_arm": vary(23.0),
        "test_count": 3,
        "test_least": vary(690.0),
        "test_mean": vary(780.0),
    }
    yield {
        "id": "strong",
        "kind": "bar",
        "bar_diameter": vary(57.0),
        "bar_strength": vary(510.0),
        "lever_arm": vary(2.3),
        "test_count": 2,
        "test_least": vary(770.0),
        "test_mean": vary(910.0),
    }
    yield {
        "id": "drilled",
        "kind": "rope anchor",
        "tendon": vary(433.0),
        "drill_diameter": vary(91.0),
        "sleeve": "no",
        "bond_length": vary(4.3),
        "ground": "sandstone",
    }


def _list_ropes(vary):
    yield {
        "id": "guy",
        "rope_diameter": 22.0,
        "construction": "6x36-IWRC",
        "grade": 1770,
        "termination": "ferrule",
    }
    yield {"id": "number", "rope": vary(287.0)}


def _list_posts(vary):
    yield {
        "id": "slim",
        "area": vary(54.3),
        "second_moment": vary(889.0),
        "buckling_length": vary(4.9),
        "yield_strength": 355,
        "buckling_curve": "b",
        "post_width": vary(160.0),
        "section_modulus": vary(311.0),
        "base_friction": vary(0.57),
        "plate_length": vary(0.61),
        "plate_width": vary(0.47),
        "bearing_stress": vary(1130.0),
    }
    yield {
        "id": "stout",
        "area": vary(78.1),
        "second_moment": vary(2003.0),
        "buckling_length": vary(3.9),
        "yield_strength": 235,
        "post_width": vary(200.0),
        "section_modulus": vary(570.0),
        "sliding": vary(171.0),
        "bearing": vary(611.0),
    }


def _list_nets(vary):
    yield {
        "id": "U1",
        "gap": vary(1.97, 3),
        "slope_angle": vary(44.1),
        "snow_height": vary(5.1),
        "upslope_length": vary(6.3),
        "ground_law": "sliding",
        "glide_factor": vary(2.37),
        "net_height": vary(4.3),
        "net_stiffness": vary(17300.0),
        "post_spacing": vary(3.43),
        "post_base_distance": vary(1.37),
        "uphill_anchor_distance": vary(4.71),
        "downhill_anchor_distance": vary(3.57),
        "foot_anchor": "bent",
        "foot_axis": vary(27.0),
        "uphill_axis": vary(31.0),
        "downhill_axis": vary(47.0),
        "uphill_anchor": "drilled",
        "downhill_anchor": "drilled",
        "uphill_guy": "guy",
        "downhill_guy": "number",
        "post": "slim",
        "panel_system": "none",
        "snow_layers": "uniform",
        "altitude": vary(2130.0),
        "guy_count": 2,
        "guy_splay": vary(23.7),
    }
    yield {
        "id": "U2",
        "slope_angle": vary(37.3),
        "snow_thickness": vary(2.41),
        "upslope_length": vary(17.9),
        "ground_law": "no-slip",
        "net_height": vary(2.93),
        "net_stiffness": vary(9170.0),
        "post_spacing": vary(3.71),
        "post_tilt": vary(11.3),
        "uphill_anchor_distance": 0.0,
        "downhill_anchor_distance": vary(2.89),
        "foot_anchor": "drilled",
        "uphill_anchor": "drilled",
        "downhill_anchor": "drilled",
        "uphill_guy": "number",
        "downhill_guy": "guy",
        "post": "stout",
        "panel_system": "none",
        "snow_layers": "uniform",
        "anchor_axes": "along the pull",
        "guy_count": 1,
    }
    yield {
        "id": "U3",
        "gap": 0.0,
        "slope_angle": vary(33.1),
        "snow_thickness": vary(2.83),
        "upslope_length": vary(14.3),
        "ground_law": "free",
        "net_height": vary(3.07),
        "net_stiffness": vary(7430.0),
        "post_spacing": vary(2.71),
        "post_tilt": vary(38.0),
        "uphill_anchor_distance": vary(3.31),
        "downhill_anchor_distance": vary(4.13),
        "foot_anchor": "strong",
        "foot_axis": vary(3.1),
        "uphill_anchor": "drilled",
        "uphill_axis": vary(29.0),
        "downhill_anchor": "drilled",
        "downhill_axis": vary(41.0),
        "uphill_guy": "guy",
        "downhill_guy": "guy",
        "post": "slim",
        "panel_system": "none",
        "snow_layers": "uniform",
        "guy_count": 2,
        "guy_splay": vary(31.0),
    }
