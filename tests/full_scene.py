"""A scene file that uses every table."""

FULL_SCENE = """
[slope]
angle_deg = 38
[snow]
thickness_m = 2.5
upslope_length_m = 6
density_kg_m3 = 300
creep_law = "boutillier-2004"
creep_exponent = 3
fluidity_per_MPa3_a = 20
[ground]
law = "sliding"
slip_length_m = 1.5
contact = "two-sided"
[net]
kind = "cable"
inclination_deg = 25
height_m = 3.0
stiffness_kN_per_m = 8000
slack = 0.05
friction_deg = 30
[gravity]
mode = "parallel"
[solve]
method = "steady"
accuracy = 0.1
start = "straight"
horizon_days = 10
"""
