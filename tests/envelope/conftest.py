"""Small tasks for the envelope: one row, the two coarsest meshes."""

import math
from collections.abc import Callable

import pytest

from netdesign.coupling.scene import Scene
from netdesign.envelope.ranges import Case
from netdesign.envelope.run import CaseTask, build_task
from netdesign.solving.runner import Runner
from netdesign.structure.layout import SupportLayout
from tests.solving.small_scene import COARSE, LAYOUT, build_scene

BuildTask = Callable[..., CaseTask]


@pytest.fixture(scope="module")
def runner() -> Runner:
    return Runner()


@pytest.fixture
def task() -> BuildTask:
    """Build a task for a density; ``kind`` may be a scene that misbehaves."""

    def build(
        density: float, *, kind: type[Scene] = Scene, layout: SupportLayout = LAYOUT
    ) -> CaseTask:
        angle = math.radians(30.0)
        case = Case(density=density, friction_angle=angle, inclination=angle)
        return build_task(
            case, lambda point: build_scene(point, kind), (layout,), COARSE
        )

    return build
