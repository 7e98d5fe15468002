"""A site of drawn numbers, unlike the example in whatever the page may show."""

import random

from tests.make import write_site

PROFILE = "eurocode"
_GROUND = "sandstone"


def write_untidy_site(path, seed):
    """Three net rows: floor and bent bar, shared anchor, loaded downhill guy."""
    write_site(path, draw_site(random.Random(seed)), measures=VERTICAL)


VERTICAL = {("rows", "snow"): "vertical"}


def draw_site(draw):
    def vary(value, digits=3):
        return float(f"{value * draw.uniform(0.97, 1.03):.{digits}g}")

    def span(low, high):
        return vary(low), vary(high)

    return {
        "project": [
            {
                "name": "Drawn slope",
                "author": "A. Nobody",
                "density": span(212.0, 277.0),
                "friction_angle": span(17.3, 38.9),
                "inclination": span(26.7, 32.6),
                "design_life": 67,
                "soil": "fill",
                "base_friction": vary(0.57),
            }
        ],
        "rows": list(_list_rows(vary)),
        "net_types": list(_list_nets(vary, span(3.4, 6.1))),
        "anchor_types": list(_list_anchors(vary)),
        "ropes": list(_list_ropes(vary)),
        "posts": list(_list_posts(vary)),
        "links": list(_list_links(vary)),
        "soils": [
            {
                "ground": _GROUND,
                "soil_cohesion": vary(71.0),
                "soil_friction": vary(34.0),
                "soil_weight": vary(20.7),
            }
        ],
        "declared": [
            {
                "row": "U1",
                "check": "Post base, sliding",
                "document": "Report 17",
                "author": "B. Nobody",
                "date": "2026-02-03",
            }
        ],
    }


def _list_rows(vary):
    yield {
        "id": "U1",
        "gap": vary(1.97, 3),
        "slope_angle": vary(44.1),
        "snow": vary(5.1),
        "upslope_length": vary(6.3),
        "glide_factor": vary(2.37),
        "altitude": vary(2130.0),
        "net_type": "tall",
        "post_spacing": vary(3.43),
        "foot_anchor": "bent",
        "uphill_anchor": "drilled",
        "downhill_anchor": "drilled",
        "end_anchor": "strong",
        "ground": _GROUND,
    }
    yield {
        "id": "U2",
        "slope_angle": vary(37.3),
        "snow": vary(3.03),
        "upslope_length": vary(17.9),
        "glide_factor": 1.0,
        "net_type": "single guys",
        "post_spacing": vary(3.71),
        "foot_anchor": "drilled",
        "uphill_anchor": "drilled",
        "downhill_anchor": "drilled",
        "end_anchor": "bent",
        "ground": _GROUND,
    }
    yield {
        "id": "U3",
        "gap": 0.0,
        "slope_angle": vary(33.1),
        "snow": vary(3.38),
        "upslope_length": vary(14.3),
        "glide_factor": "free",
        "net_type": "leaning posts",
        "post_spacing": vary(2.71),
        "foot_anchor": "strong",
        "uphill_anchor": "drilled",
        "downhill_anchor": "drilled",
        "end_anchor": "strong",
        "ground": _GROUND,
    }


def _list_nets(vary, slack):
    ropes = {"ridge_rope": "border", "lower_rope": "border", "end_guy": "border"}
    yield {
        "id": "tall",
        "net_height": vary(4.3),
        "net_stiffness": vary(17300.0),
        "slack": slack,
        "post_tilt": vary(14.7),
        "uphill_anchor_distance": vary(4.71),
        "downhill_anchor_distance": vary(3.57),
        "guy_count": 2,
        "guy_splay": vary(23.7),
        "guy_anchors": "shared",
        "ridge_sag": vary(11.7),
        "lower_sag": vary(9.3),
        "end_guy_angle": vary(33.0),
        "mesh_strength": vary(231.0),
        "uphill_guy": "guy",
        "downhill_guy": "number",
        "post": "slim",
        **ropes,
    }
    yield {
        "id": "single guys",
        "net_height": vary(2.93),
        "net_stiffness": vary(9170.0),
        "slack": slack,
        "post_tilt": vary(11.3),
        "uphill_anchor_distance": 0.0,
        "downhill_anchor_distance": vary(2.89),
        "guy_count": 1,
        "ridge_sag": vary(13.1),
        "mesh_strength": vary(231.0),
        "uphill_guy": "number",
        "downhill_guy": "guy",
        "post": "stout",
        **ropes,
    }
    yield {
        "id": "leaning posts",
        "net_height": vary(3.07),
        "net_stiffness": vary(7430.0),
        "slack": slack,
        "post_tilt": vary(38.0),
        "uphill_anchor_distance": vary(3.31),
        "downhill_anchor_distance": vary(4.13),
        "guy_count": 2,
        "guy_splay": vary(31.0),
        "guy_anchors": "own",
        "ropes_at_supports": "slide",
        "mesh_strength": vary(231.0),
        "uphill_guy": "guy",
        "downhill_guy": "guy",
        "post": "slim",
        **ropes,
    }


def _list_anchors(vary):
    yield {
        "id": "bent",
        "kind": "micropile",
        "tendon": vary(811.0),
        "bar_diameter": vary(51.0),
        "ground": _GROUND,
        "pull_out": vary(690.0),
        "proven": "tests",
        "test_count": 3,
        "test_mean": vary(780.0),
        "dip": vary(22.0),
        "drilled_length": vary(7.3),
        "lever_arm": vary(23.0),
        "protection": "sacrificial",
    }
    yield {
        "id": "strong",
        "kind": "bar",
        "tendon": vary(1290.0),
        "bar_diameter": vary(57.0),
        "ground": _GROUND,
        "pull_out": vary(770.0),
        "proven": "tests",
        "test_count": 2,
        "test_mean": vary(910.0),
        "dip": vary(19.0),
        "drilled_length": vary(7.3),
        "tube_diameter": vary(89.0),
        "tube_wall": vary(8.8),
        "lever_arm": vary(2.3),
        "protection": "sacrificial",
        "at_end": "bent",
    }
    yield {
        "id": "drilled",
        "kind": "rope anchor",
        "tendon": vary(433.0),
        "ground": _GROUND,
        "pull_out": vary(347.0),
        "proven": "calculated",
        "dip": vary(27.0),
        "drill_diameter": vary(91.0),
        "drilled_length": vary(7.3),
        "bond_length": vary(4.3),
        "head_across": vary(211.0),
        "protection": "sheath",
    }


def _list_ropes(vary):
    yield {"id": "guy", "rope": vary(301.0), "termination": "ferrule"}
    yield {"id": "number", "rope": vary(287.0), "termination": "wedge"}
    yield {
        "id": "border",
        "rope": vary(611.0),
        "termination": "included",
        "axial_stiffness": vary(41300.0),
    }


def _list_posts(vary):
    yield {
        "id": "slim",
        "yield_strength": 355,
        "area": vary(54.3),
        "second_moment": vary(889.0),
        "section_modulus": vary(311.0),
        "post_width": vary(160.0),
        "buckling_curve": "b",
        "buckling_length": vary(4.9),
        "bearing": vary(324.0),
    }
    yield {
        "id": "stout",
        "yield_strength": 235,
        "area": vary(78.1),
        "second_moment": vary(2003.0),
        "section_modulus": vary(570.0),
        "post_width": vary(200.0),
        "buckling_length": vary(3.9),
        "head_eccentricity": vary(21.0),
        "bearing": vary(611.0),
    }


def _list_links(vary):
    for name, kind, force, meaning, more in (
        ("drilled", "eye", 371.0, "strength", {}),
        ("bent", "shackle", 133.0, "limit", {"count": 2}),
        ("guy", "shackle", 310.0, "strength", {}),
        ("guy", "thimble", 97.0, "limit", {}),
        ("number", "turnbuckle", 287.0, "strength", {}),
        ("strong", "plate", 613.0, "strength", {}),
        ("border", "shackle", 190.0, "limit", {"angle": vary(31.0)}),
    ):
        link = {"type": name, "link": kind, "force": vary(force), "meaning": meaning}
        yield link | more
