#!/usr/bin/env python3
"""The example of README.md, one line through all returns, as a program."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../clients"))
import scanbench  # noqa: E402


class MyLines:
    kind, name, version = "extract", "my_lines_py", "1.0"
    summary, reference = "one line through all returns", "none"
    params = [scanbench.integer("min_points", 2, min=2, doc="fewest returns that make a line")]

    def __init__(self, params):
        self.min_points = params["min_points"]

    def extract(self, scan):
        beams = scan.valid_beams()
        if len(beams) < self.min_points:
            return []
        points = {scan.point(i) for i in beams}
        return [scan.fitted_line(beams)] if len(points) > 1 else []


scanbench.serve(MyLines)
