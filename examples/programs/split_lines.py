#!/usr/bin/env python3
"""A line extractor as a program: iterative end-point fit (Ramer 1972; Duda & Hart 1973)."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../clients"))
import scanbench  # noqa: E402


class SplitLines:
    kind, name, version = "extract", "split_lines", "1.0"
    summary, reference = "iterative end-point fit, in Python", "Ramer 1972; Duda & Hart 1973"
    params = [
        scanbench.number("threshold_m", 0.10, above=0, unit="m", doc="largest distance of a point from the chord"),
        scanbench.integer("min_points", 6, min=2, doc="fewest points of a line"),
        scanbench.number("max_gap_m", 0.5, above=0, unit="m", doc="largest distance between neighbours of a line"),
    ]

    def __init__(self, params):
        self.threshold_m, self.min_points = params["threshold_m"], params["min_points"]
        self.max_gap_m = params["max_gap_m"]

    def extract(self, scan):
        lines, group = [], []
        for beam in scan.valid_beams():
            if group and math.dist(scan.point(group[-1]), scan.point(beam)) > self.max_gap_m:
                self.split(scan, group, lines)
                group = []
            group.append(beam)
        self.split(scan, group, lines)
        return lines

    def split(self, scan, beams, lines):
        """Appends the lines of a group of beams, by a stack instead of recursion."""
        todo = [beams]
        while todo:
            part = todo.pop()
            if len(part) < self.min_points:
                continue
            (ax, ay), (bx, by) = scan.point(part[0]), scan.point(part[-1])
            length = math.hypot(bx - ax, by - ay)
            if length == 0.0:
                continue
            off = [abs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / length for x, y in map(scan.point, part)]
            far = max(range(len(part)), key=off.__getitem__)
            if off[far] <= self.threshold_m:
                lines.append(scan.fitted_line(part))
            else:
                todo += [part[far:], part[:far]]  # the first part is next


scanbench.serve(SplitLines)
