"""Workers that remember what they were asked for, or change what they answer."""

from itertools import chain

from netdesign.solving.workers import OwnProcess


class Recording(OwnProcess):
    """Keeps the batches of each call."""

    def __init__(self):
        self.waves = []

    @property
    def jobs(self):
        """All jobs, whatever batch they came in."""
        return list(chain.from_iterable(chain.from_iterable(self.waves)))

    def solve(self, batches):
        self.waves.append(batches)
        return super().solve(batches)


class Spoiling(OwnProcess):
    """Gives the ends that ``spoil`` makes of a job and its end."""

    def __init__(self, spoil):
        self._spoil = spoil

    def solve(self, batches):
        for place, ends in super().solve(batches):
            solved = zip(batches[place], ends, strict=False)
            yield place, [self._spoil(job, end) for job, end in solved]


def finish(steps, solve):
    """End of a search, whose batches are solved one wave after the other."""
    ends = None
    while True:
        try:
            batches = steps.send(ends)
        except StopIteration as end:
            return end.value
        ends = solve(batches)
