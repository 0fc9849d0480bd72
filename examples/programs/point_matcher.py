#!/usr/bin/env python3
"""A scan matcher as a program: point-to-point ICP (Besl & McKay 1992; Lu & Milios 1997)."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../clients"))
import scanbench  # noqa: E402


class PointMatcher:
    kind, name, version = "match", "point_matcher", "1.0"
    summary, reference = "point-to-point ICP, in Python", "Besl & McKay 1992"
    params = [
        scanbench.number("max_distance_m", 0.3, above=0, unit="m", doc="farthest pair"),
        scanbench.integer("iterations", 30, min=1, doc="most iterations"),
        scanbench.integer("every", 4, min=1, doc="of the points of the current scan, one in this many is used"),
    ]

    def __init__(self, params):
        self.reach, self.iterations, self.every = params["max_distance_m"], params["iterations"], params["every"]

    def match(self, reference, current, guess):
        fixed = [reference.point(i) for i in reference.valid_beams()]
        moving = [current.point(i) for i in current.valid_beams()][::self.every]
        cells = {}  # a grid of `reach`: the nearest point is in one of nine cells
        for p in fixed:
            cells.setdefault((math.floor(p[0] / self.reach), math.floor(p[1] / self.reach)), []).append(p)
        pose = guess
        for _ in range(self.iterations):
            pairs = [(q, p) for q in moving for p in [self.nearest(cells, pose * q)] if p is not None]
            if len(pairs) < 3:
                return "no_match", guess
            better = self.fitted(pairs)
            change = pose.inverse() * better
            pose = better
            if math.hypot(change.x, change.y) < 1e-6 and abs(change.yaw) < 1e-6:
                return "converged", pose
        return "max_iterations", pose

    def nearest(self, cells, p):
        i, j = math.floor(p[0] / self.reach), math.floor(p[1] / self.reach)
        best, found = self.reach, None
        for a in (i - 1, i, i + 1):
            for b in (j - 1, j, j + 1):
                for candidate in cells.get((a, b), ()):
                    distance = math.dist(p, candidate)
                    if distance < best:
                        best, found = distance, candidate
        return found

    @staticmethod
    def fitted(pairs):
        """The motion of least squares that maps the first points of the pairs to the second."""
        n = len(pairs)
        qx, qy = sum(q[0] for q, _ in pairs) / n, sum(q[1] for q, _ in pairs) / n
        px, py = sum(p[0] for _, p in pairs) / n, sum(p[1] for _, p in pairs) / n
        dot = sum((q[0] - qx) * (p[0] - px) + (q[1] - qy) * (p[1] - py) for q, p in pairs)
        cross = sum((q[0] - qx) * (p[1] - py) - (q[1] - qy) * (p[0] - px) for q, p in pairs)
        norm = math.hypot(dot, cross)
        c, s = (dot / norm, cross / norm) if norm > 0 else (1.0, 0.0)
        return scanbench.Pose(px - c * qx + s * qy, py - s * qx - c * qy, cos=c, sin=s)


scanbench.serve(PointMatcher)
