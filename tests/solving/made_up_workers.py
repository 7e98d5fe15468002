"""Workers that remember what they were asked for, or change what they answer."""

from itertools import chain

from netdesign.solving.workers import OwnProcess


class Recording(OwnProcess):
    """Keeps the jobs of each call."""

    def __init__(self):
        self.waves = []

    @property
    def jobs(self):
        """All jobs, whatever wave they came in."""
        return list(chain.from_iterable(self.waves))

    def solve(self, jobs):
        self.waves.append(jobs)
        return super().solve(jobs)


class Spoiling(OwnProcess):
    """Gives the ends that ``spoil`` makes of a job and its end."""

    def __init__(self, spoil):
        self._spoil = spoil

    def solve(self, jobs):
        for place, end in super().solve(jobs):
            yield place, self._spoil(jobs[place], end)


def finish(steps, solve):
    """End of a search, whose jobs are solved one wave after the other."""
    ends = None
    while True:
        try:
            jobs = steps.send(ends)
        except StopIteration as end:
            return end.value
        ends = solve(jobs)
