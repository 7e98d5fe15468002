"""A scene file of a small scene that is soon solved."""

SMALL_SCENE = """
[slope]
angle_deg = 38
[snow]
thickness_m = 2.5
upslope_length_m = 6
density_kg_m3 = 300
[ground]
law = "no-slip"
[net]
inclination_deg = 30
stiffness_kN_per_m = 8000
slack = 0.05
friction_deg = 30
"""

# On free ground, by a net across the slope, roughly.
ROUGH_SCENE = """
[slope]
angle_deg = 38
[snow]
thickness_m = 2.5
upslope_length_m = 6
density_kg_m3 = 300
[net]
stiffness_kN_per_m = 8000
slack = 0.05
friction_deg = 30
[solve]
accuracy = 0.1
"""
