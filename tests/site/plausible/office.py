"""An office's tables whose types no catalogue knows, and slips in them."""

import random

ROWS = 4  # fewer than a median of a column needs


def draw_office(seed, *, rows=ROWS):
    """Tables of a site by key; every row has a net type of its own."""
    draw = random.Random(seed)
    height = draw.choice((2.5, 3.0, 3.5))
    tilt, splay = draw.choice((12, 15, 18)), draw.choice((15, 20, 25))
    strong = 10 * draw.randint(38, 46)
    numbers = range(1, rows + 1)
    nets = [_draw_net(draw, f"N{k}", height, tilt, splay) for k in numbers]
    return {
        "project": [
            {"standard": "swiss-guideline-2007", "density": "270 to 400"}
            | {"friction_angle": "15 to 45", "inclination": "25 to 35"}
        ],
        "rows": [
            _draw_row(draw, f"W{k}", net) for k, net in zip(numbers, nets, strict=True)
        ],
        "net_types": nets,
        "anchor_types": [
            _draw_anchor("long", strong, 0.8 * strong),
            _draw_anchor("short", strong - 100, strong - 190),
        ],
        "ropes": [{"id": "rope", "rope": 10 * draw.randint(20, 26)}],
        "posts": [{"id": "post", "bearing": 10 * draw.randint(20, 40)}],
    }


def _draw_row(draw, name, net):
    return {
        "id": name,
        "slope_angle": draw.randint(30, 46),
        "snow": round(net["net_height"] * draw.uniform(0.8, 1.0), 2),
        "glide_factor": draw.choice((1.8, 2.0, 2.2, 2.5)),
        "upslope_length": draw.randint(12, 28),
        "altitude": 10 * draw.randint(185, 215),
        "net_type": net["id"],
        "post_spacing": draw.choice((3.0, 3.5, 3.5)),
        "foot_anchor": "long",
        "uphill_anchor": draw.choice(("long", "short")),
        "downhill_anchor": "short",
        "ground": "till",
    }


def _draw_net(draw, name, height, tilt, splay):
    own = height + draw.choice((0.0, 0.0, 0.5))
    return {
        "id": name,
        "net_height": own,
        "slack": draw.choice((5, 6)),
        "post_tilt": tilt,
        "guy_count": 2,
        "guy_splay": splay,
        "uphill_anchor_distance": round(own * draw.uniform(0.8, 1.2), 1),
        "downhill_anchor_distance": round(own * draw.uniform(0.8, 1.2), 1),
        "guy_anchors": "shared",
        "net_stiffness": 8000,
        "mesh_strength": 180,
        "uphill_guy": "rope",
        "downhill_guy": "rope",
        "post": "post",
    }


def _draw_anchor(name, tendon, least):
    return {
        "id": name,
        "kind": "rope anchor",
        "tendon": tendon,
        "ground": "till",
        "pull_out": round(least),
        "proven": "tests",
    }


def alter(tables, place, value):
    """Tables with another number in one cell."""
    table, number, key = place
    kept = {name: [dict(line) for line in lines] for name, lines in tables.items()}
    kept[table][number][key] = value
    return kept
