#!/usr/bin/python3
"""RANSAC of scikit-learn as a line extractor: RANSACRegressor, again and again on the points that are left.

scikit-learn fits one model to all points, here a LinearRegression of y on x, and of x on y for steep walls; the model
with more inliers is taken. What follows is not scikit-learn's: of the inliers the largest stretch without a gap in scan
order becomes a line, fitted by orthogonal least squares, and its points are removed. The search ends where no stretch
has enough points.
"""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../clients"))
import scanbench  # noqa: E402

try:
    import numpy
    import sklearn
    from sklearn.linear_model import RANSACRegressor
except ImportError as error:
    sys.exit(f"sk_ransac.py: {error} ({sys.executable}); `./scanbench peers` installs what the peers need")


class SkRansac:
    kind, name, version = "extract", "sk_ransac", sklearn.__version__
    summary = "RANSACRegressor of scikit-learn, repeatedly on the points that are left"
    reference = "scikit-learn, sklearn.linear_model; the repetition and the segments are ours"
    params = [
        scanbench.integer("seed", 1, min=0, max=2147483647, doc="random_state"),
        scanbench.integer("trials", 100, min=1, max=10000, doc="max_trials; scikit-learn's default"),
        scanbench.number("sigmas", 3, min=0, max=100, doc="residual_threshold in standard deviations of the noise"),
        scanbench.number("floor_m", 0.01, min=0, max=10, unit="m", doc="smallest residual_threshold"),
        scanbench.number("max_gap_m", 0.3, above=0, unit="m", doc="longest gap between neighbouring points of a line"),
        scanbench.integer("max_lines", 100, min=1, max=10000, doc="most lines of a scan"),
        scanbench.integer("min_points", 8, min=2, max=1000000, doc="fewest points of a line"),
        scanbench.number("min_length_m", 0.1, min=0, unit="m", doc="shortest line"),
    ]

    def __init__(self, params):
        self.__dict__.update(params)

    def extract(self, scan):
        beams = numpy.array(scan.valid_beams(), dtype=int)
        if len(beams) == 0:
            return []
        ranges = numpy.asarray(scan.ranges)[beams]
        points = ranges[:, None] * numpy.array(scan.sensor.directions)[beams]
        threshold = max(self.floor_m, self.sigmas * self.noise_m(scan.sensor, float(ranges.mean())))
        free = numpy.arange(len(beams))
        lines = []
        while len(free) >= self.min_points and len(lines) < self.max_lines:
            inliers = self.consensus(points[free], threshold)
            stretch = self.largest_stretch(points, free[inliers])
            if len(stretch) < self.min_points:
                break
            free = numpy.setdiff1d(free, stretch)
            if numpy.ptp(points[stretch], axis=0).max() > 0:
                line = scan.fitted_line(beams[stretch].tolist())
                if math.dist(line.a, line.b) >= self.min_length_m:
                    lines.append(line)
        return sorted(lines, key=lambda line: line.first_beam)

    def consensus(self, points, threshold):
        """The mask of the inliers of the better of two regressions."""
        masks = [numpy.zeros(len(points), dtype=bool)]
        for given, wanted in ((0, 1), (1, 0)):
            model = RANSACRegressor(max_trials=self.trials, residual_threshold=threshold, random_state=self.seed)
            try:
                model.fit(points[:, [given]], points[:, wanted])
            except ValueError:  # no sample had a consensus
                continue
            masks.append(model.inlier_mask_)
        return max(masks, key=numpy.count_nonzero)

    def largest_stretch(self, points, inliers):
        if len(inliers) == 0:
            return inliers
        steps = numpy.hypot(*numpy.diff(points[inliers], axis=0).T)
        return max(numpy.split(inliers, numpy.flatnonzero(steps > self.max_gap_m) + 1), key=len)

    @staticmethod
    def noise_m(sensor, range_m):
        """Standard deviation of a reading, from the data sheet."""
        relative = sensor.sigma_relative * range_m
        if sensor.relative_from_m > 0:
            gaussian = sensor.sigma_m if range_m < sensor.relative_from_m else relative
        else:
            gaussian = math.hypot(sensor.sigma_m, relative)
        return math.hypot(gaussian, sensor.quantum_m / math.sqrt(12))


scanbench.serve(SkRansac)
