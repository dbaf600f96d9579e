"""Places along a path, dense where it bends."""
import numpy as np


def graded_places(marks, step_at):
    """Places with every mark among them, no farther apart than `step_at(places)`."""
    places = [marks[:1]]
    for begin, end in zip(marks[:-1], marks[1:]):
        inside = np.linspace(begin, end, 65)
        density = 1 / step_at(np.clip(inside, begin + 1e-9, end - 1e-9))
        count = np.concatenate([[0], np.cumsum((density[1:] + density[:-1]) / 2 * np.diff(inside))])
        places.append(np.interp(np.linspace(0, count[-1], int(np.ceil(count[-1])) + 1)[1:], count, inside))
    return np.concatenate(places)
