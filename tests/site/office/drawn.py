"""Drawn contents of an input workbook, as tables by key."""

import random

GROUNDS = ("till", "scree", "gravel", "rock")


def draw_tables(seed, rows=4):
    """Tables of a site with every column of Rows, Net types and Anchors filled in."""
    rng = random.Random(seed)

    def pick(low, high, digits=1):
        return round(rng.uniform(low, high), digits)

    nets = [f"SN {n}.{rng.randint(0, 9)}" for n in range(rng.randint(1, 3))]
    anchors = [f"GEWI {n}" for n in rng.sample(range(20, 60), 4)]
    height = {net: pick(2.5, 4.0, 2) for net in nets}
    lines = []
    for number in range(rows):
        net = rng.choice(nets)
        lines.append(
            {
                "id": f"A{number + 1}",
                "slope_angle": pick(30, 45),
                "snow": pick(0.8 * height[net], height[net], 2),
                "glide_factor": pick(1.2, 3.0, 2),
                "upslope_length": pick(12, 40),
                "post_count": rng.randint(3, 30),
                "altitude": rng.randint(900, 2800),
                "net_type": net,
                "post_spacing": pick(3, 4.5),
                "foot_anchor": rng.choice(anchors),
                "uphill_anchor": rng.choice(anchors),
                "downhill_anchor": rng.choice(anchors),
                "end_anchor": rng.choice(anchors),
                "ground": "till",
                "gap": pick(0.5, 4),
            }
        )
    return {
        "project": [
            {
                "name": f"Site {seed}",
                "density": (rng.randint(250, 300), rng.randint(380, 450)),
                "friction_angle": (pick(10, 18), pick(30, 44)),
                "inclination": (pick(20, 27), pick(30, 38)),
                "design_life": rng.randint(40, 100),
                "soil": "natural",
                "base_friction": pick(0.3, 0.6, 2),
            }
        ],
        "rows": lines,
        "net_types": [draw_net(rng, pick, net, height[net]) for net in nets],
        "anchor_types": [draw_anchor(rng, pick, one) for one in anchors],
        "ropes": [
            {"id": f"S {d}", "rope": d * d, "termination": "included"}
            for d in (18, 20, 22, 24)
        ],
        "posts": [{"id": "HEA 160", "yield_strength": 355, "bearing": 400}],
    }


def draw_net(rng, pick, name, height):
    return {
        "id": name,
        "net_height": height,
        "approval": "TA 12-3",
        "glide_most": pick(2, 3.2),
        "altitude_most": pick(1, 1.4),
        "spacing_most": pick(3.5, 5),
        "maker_foot": rng.randint(100, 200),
        "maker_uphill": rng.randint(60, 120),
        "maker_downhill": rng.randint(20, 60),
        "slack": pick(3, 9),
        "post_tilt": pick(8, 20),
        "guy_count": 2,
        "guy_splay": pick(12, 25),
        "uphill_anchor_distance": pick(2, 4),
        "downhill_anchor_distance": pick(2, 4),
        "guy_anchors": rng.choice(["own", "shared"]),
        "net_stiffness": rng.randint(3000, 20000),
        "ridge_sag": pick(4, 9),
        "lower_sag": pick(4, 9),
        "end_guy_angle": pick(20, 40),
        "mesh_strength": rng.randint(80, 300),
        "ridge_rope": "S 22",
        "lower_rope": "S 24",
        "uphill_guy": "S 18",
        "downhill_guy": "S 18",
        "end_guy": "S 20",
        "post": "HEA 160",
    }


def draw_anchor(rng, pick, name):
    diameter = int(name.split()[1])
    tendon = round(0.45 * diameter**2)
    least = round(0.6 * tendon)
    return {
        "id": name,
        "kind": "bar",
        "tendon": tendon,
        "bar_diameter": diameter,
        "ground": "till",
        "pull_out": least,
        "proven": "tests",
        "test_count": rng.randint(1, 6),
        "test_mean": least + rng.randint(0, 9),
        "dip": pick(10, 30),
        "drill_diameter": 2 * diameter + 30,
        "drilled_length": pick(5, 9),
        "bond_length": pick(3, 5),
        "tube_diameter": 114.3,
        "tube_wall": 10,
        "lever_arm": 5,
        "protection": "cover",
    }
