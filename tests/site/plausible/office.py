"""An office's tables whose types no catalogue knows, and slips in them."""

import random

from tests.site.office.drawn import draw_line

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
            _draw_anchor(draw, "long", strong, 0.8 * strong),
            _draw_anchor(draw, "short", strong - 100, strong - 190),
        ],
        "ropes": [{"id": "rope", "rope": 10 * draw.randint(20, 26)}],
        "posts": [{"id": "post", "bearing": 10 * draw.randint(20, 40)}],
    }


def _draw_row(draw, name, net):
    snow = round(net["net_height"] * draw.uniform(0.8, 1.0), 2)
    line = {"id": name, "snow": snow, "net_type": net["id"]}
    return line | draw_line(draw, "office_rows")


def _draw_net(draw, name, height, tilt, splay):
    own = height + draw.choice((0.0, 0.0, 0.5))
    line = {"id": name, "net_height": own, "post_tilt": tilt, "guy_splay": splay}
    for side in ("uphill", "downhill"):
        line[f"{side}_anchor_distance"] = round(own * draw.uniform(0.8, 1.2), 1)
    return line | draw_line(draw, "office_net_types")


def _draw_anchor(draw, name, tendon, least):
    line = {"id": name, "tendon": tendon, "pull_out": round(least)}
    return line | draw_line(draw, "office_anchor_types")


def alter(tables, place, value):
    """Tables with another number in one cell."""
    table, number, key = place
    kept = {name: [dict(line) for line in lines] for name, lines in tables.items()}
    kept[table][number][key] = value
    return kept
