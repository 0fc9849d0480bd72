"""A client of scanbench: modules in Python. One file, Python 3.9 or later, no other package.

    import scanbench

    class MyLines:
        kind, name, version = "extract", "my_lines", "1.0"
        summary, reference = "one line through all returns", "none"
        params = [scanbench.integer("min_points", 2, min=2, doc="fewest returns that make a line")]

        def __init__(self, params):
            self.min_points = params["min_points"]

        def extract(self, scan):
            beams = scan.valid_beams()
            return [scan.fitted_line(beams)] if len(beams) >= self.min_points else []

    scanbench.serve(MyLines)

The methods of the kinds, with poses as Pose and lines as Line:

    extract(scan)                              -> list of Line, in the order of their first beams
    match(reference, current, guess)           -> (status, Pose of current in the frame of reference[, 3 x 3 covariance])
    align(scans, initial)                      -> (status, list of Pose[, message])
    insert(scan, guess), map()                 -> (status, Pose, number of lines[, message]), list of MapLine
    merge(lines, points)                       -> (status, list of MapLine, labels[, cluster1, cluster2])

A status is "converged", "max_iterations", "degenerate" or "no_match". Arrays are array.array("d"), which
numpy.asarray() reads without copying. An exception is reported to scanbench and ends the cell.
"""
import array
import json
import math
import os
import socket
import struct
import sys
import traceback

PROTOCOL = 1
_HEAD = struct.Struct("<4sIQ")


def _spec(type_, name, default, doc="", unit="", min=None, max=None, above=None, choices=None):
    spec = {"name": name, "type": type_, "default": default, "doc": doc, "unit": unit}
    if above is not None:
        spec.update(min=above, open_min=True)
    if min is not None:
        spec["min"] = min
    if max is not None:
        spec["max"] = max
    if choices is not None:
        spec["choices"] = list(choices)
    return spec


def number(name, default, **more):
    """A real parameter; more: doc, unit, min, max, above (a bound that is itself not allowed)."""
    return _spec("number", name, float(default), **more)


def integer(name, default, **more):
    return _spec("integer", name, int(default), **more)


def boolean(name, default, **more):
    return _spec("boolean", name, bool(default), **more)


def choice(name, default, choices, **more):
    return _spec("choice", name, default, choices=choices, **more)


class Pose:
    """A rigid motion: rotation (cos, sin) and translation (x, y) in metres."""

    __slots__ = ("x", "y", "cos", "sin")

    def __init__(self, x=0.0, y=0.0, yaw=0.0, *, cos=None, sin=None):
        self.x, self.y = x, y
        self.cos = math.cos(yaw) if cos is None else cos
        self.sin = math.sin(yaw) if sin is None else sin

    @property
    def yaw(self):
        return math.atan2(self.sin, self.cos)

    def __mul__(self, other):
        """Of two poses the motion of both; of a point (x, y) its image."""
        if isinstance(other, Pose):
            x, y = self * (other.x, other.y)
            return Pose(x, y, cos=self.cos * other.cos - self.sin * other.sin,
                        sin=self.sin * other.cos + self.cos * other.sin)
        px, py = other
        return (self.cos * px - self.sin * py + self.x, self.sin * px + self.cos * py + self.y)

    def inverse(self):
        return Pose(-self.cos * self.x - self.sin * self.y, self.sin * self.x - self.cos * self.y, cos=self.cos,
                    sin=-self.sin)

    def _row(self):
        norm = math.hypot(self.cos, self.sin)
        norm = 1.0 if abs(norm - 1.0) < 1e-12 else norm  # a pose that is passed on keeps its bits
        return (self.x, self.y, self.cos / norm, self.sin / norm)


class Line:
    """A line of one scan, sensor frame; free space is on the left of a -> b. `beams` are those that it explains, in
    ascending order. `covariance`: (var(offset), cov, var(angle)) at the midpoint, or None."""

    __slots__ = ("a", "b", "rho", "alpha", "beams", "first_beam", "last_beam", "points", "rms_m", "covariance")

    def __init__(self, a, b, beams, rms_m=0.0, covariance=None, rho=None, alpha=None):
        self.a, self.b, self.beams = a, b, beams
        self.rms_m, self.covariance = rms_m, covariance
        self.first_beam, self.last_beam = (beams[0], beams[-1]) if len(beams) else (-1, -1)
        self.points = len(beams)
        self.rho, self.alpha = (rho, alpha) if rho is not None else polar(a, b)


class MapLine:
    """A line of a map, world frame. `covariance` as of Line; (0, 0, 0): unknown."""

    __slots__ = ("a", "b", "covariance", "members", "points")

    def __init__(self, a, b, covariance=(0.0, 0.0, 0.0), members=1, points=0):
        self.a, self.b, self.covariance, self.members, self.points = a, b, covariance, members, points

    def _row(self):
        return (*self.a, *self.b, *self.covariance, self.members, self.points)


def polar(a, b):
    """(rho, alpha) of x cos(alpha) + y sin(alpha) = rho with rho >= 0 and alpha in (-pi, pi]."""
    length = math.hypot(b[0] - a[0], b[1] - a[1])
    nx, ny = (b[1] - a[1]) / length, (a[0] - b[0]) / length
    rho = nx * (a[0] + b[0]) / 2 + ny * (a[1] + b[1]) / 2
    if rho < 0:
        rho, nx, ny = -rho, -nx, -ny
    alpha = math.atan2(ny, nx)
    return rho, math.pi if alpha <= -math.pi else alpha


class Sensor:
    """The sensor's data sheet. Beam i points to angle_min_rad + i * angle_step_rad. `directions`: (cos, sin) per beam."""

    def __init__(self, sheet):
        self.__dict__.update(sheet)
        angles = [self.angle_min_rad + i * self.angle_step_rad for i in range(self.beams)]
        self.directions = [(math.cos(angle), math.sin(angle)) for angle in angles]


class Scan:
    """One scan: `ranges` in metres (+inf nothing in range, -inf too close, NaN faulty), `stamp_s`, `sensor`; of kinds
    other than extract also `lines`."""

    def __init__(self, sensor, ranges, stamp_s, lines=None):
        self.sensor, self.ranges, self.stamp_s, self.lines = sensor, ranges, stamp_s, lines

    def valid_beams(self):
        return [i for i, r in enumerate(self.ranges) if 0.0 < r < math.inf]

    def point(self, beam):
        r, (c, s) = self.ranges[beam], self.sensor.directions[beam]
        return r * c, r * s

    def fitted_line(self, beams):
        """The orthogonal least-squares line through the points of these beams, which must not all be one point."""
        points = [self.point(i) for i in beams]
        mx = sum(p[0] for p in points) / len(points)
        my = sum(p[1] for p in points) / len(points)
        xx = sum((p[0] - mx) ** 2 for p in points)
        yy = sum((p[1] - my) ** 2 for p in points)
        xy = sum((p[0] - mx) * (p[1] - my) for p in points)
        direction = 0.5 * math.atan2(2 * xy, xx - yy)
        dx, dy = math.cos(direction), math.sin(direction)

        def foot(p):
            t = (p[0] - mx) * dx + (p[1] - my) * dy
            return mx + t * dx, my + t * dy

        a, b = foot(points[0]), foot(points[-1])
        if a[0] * b[1] - a[1] * b[0] < 0:  # the sensor, at the origin, is on the left of a -> b
            a, b = b, a
        rho, nx, ny = my * dx - mx * dy, -dy, dx
        if rho < 0:
            rho, nx, ny = -rho, -nx, -ny
        alpha = math.atan2(ny, nx)
        square = sum((nx * p[0] + ny * p[1] - rho) ** 2 for p in points) / len(points)
        return Line(a, b, beams, rms_m=math.sqrt(square), rho=rho, alpha=math.pi if alpha <= -math.pi else alpha)


def _receive(connection, count):
    data = bytearray(count)
    view = memoryview(data)
    done = 0
    while done < count:
        n = connection.recv_into(view[done:])
        if n == 0:
            sys.exit(0)  # scanbench has closed the socket: the work is done
        done += n
    return data


def _read(connection):
    magic, header_bytes, numbers = _HEAD.unpack(_receive(connection, _HEAD.size))
    if magic != b"SBF1":
        sys.exit("scanbench.py: this is not a frame of the protocol")
    header = json.loads(_receive(connection, header_bytes))
    data = array.array("d")
    data.frombytes(_receive(connection, 8 * numbers))
    arrays, at = {}, 0
    for name, length in header.get("arrays", ()):
        arrays[name] = data[at:at + length]
        at += length
    return header, arrays


def _write(connection, header, arrays):
    header["arrays"] = [[name, len(numbers)] for name, numbers in arrays.items()]
    text = json.dumps(header).encode()
    parts = [numbers if isinstance(numbers, array.array) else array.array("d", numbers) for numbers in arrays.values()]
    count = sum(len(part) for part in parts)
    connection.sendall(b"".join([_HEAD.pack(b"SBF1", len(text), count), text, *(part.tobytes() for part in parts)]))


def _rows(numbers, columns):
    return [numbers[i:i + columns] for i in range(0, len(numbers), columns)]


def _lines(arrays, prefix):
    lines = []
    labels = arrays[prefix + "labels"]
    beams = {}
    for beam, label in enumerate(labels):
        beams.setdefault(int(label), []).append(beam)
    covariances = _rows(arrays[prefix + "covariances"], 3)
    for i, row in enumerate(_rows(arrays[prefix + "lines"], 10)):
        covariance = tuple(covariances[i]) if covariances[i][0] == covariances[i][0] else None
        lines.append(Line((row[0], row[1]), (row[2], row[3]), beams.get(i, []), row[9], covariance, row[4], row[5]))
    return lines


def _scan(arrays, prefix, sensor):
    return Scan(sensor, arrays[prefix + "ranges"], arrays[prefix + "stamp_s"][0], _lines(arrays, prefix))


def _poses(numbers):
    return [Pose(row[0], row[1], cos=row[2], sin=row[3]) for row in _rows(numbers, 4)]


def _flat(rows):
    return [number for row in rows for number in row]


def _extract(module, arrays, sensor):
    scan = Scan(sensor, arrays["ranges"], arrays["stamp_s"][0])
    lines = list(module.extract(scan))
    labels = array.array("d", [-1.0]) * len(scan.ranges)
    rows, covariances = [], []
    for i, line in enumerate(lines):
        for beam in line.beams:
            labels[beam] = i
        rows += (*line.a, *line.b, line.rho, line.alpha, line.first_beam, line.last_beam, line.points, line.rms_m)
        covariances += line.covariance if line.covariance is not None else (math.nan,) * 3
    return {}, {"lines": rows, "covariances": covariances, "labels": labels}


def _match(module, arrays, sensor):
    status, pose, *covariance = module.match(_scan(arrays, "reference.", sensor), _scan(arrays, "current.", sensor),
                                             _poses(arrays["guess"])[0])
    result = {"pose": pose._row()}
    if covariance:
        result["covariance"] = _flat(covariance[0])
    return {"status": status}, result


def _align(module, arrays, sensor):
    scans, at, lines_at = [], 0, 0
    counts = [int(count) for count in arrays["line_counts"]]
    beams = len(arrays["ranges"]) // max(1, len(counts))
    for k, count in enumerate(counts):
        part = {"ranges": arrays["ranges"][at:at + beams], "labels": arrays["labels"][at:at + beams],
                "stamp_s": arrays["stamp_s"][k:k + 1],
                "lines": arrays["lines"][10 * lines_at:10 * (lines_at + count)],
                "covariances": arrays["covariances"][3 * lines_at:3 * (lines_at + count)]}
        scans.append(_scan(part, "", sensor))
        at, lines_at = at + beams, lines_at + count
    status, poses, *message = module.align(scans, _poses(arrays["initial"]))
    return {"status": status, "message": message[0] if message else ""}, {"poses": _flat(p._row() for p in poses)}


def _insert(module, arrays, sensor):
    status, pose, lines, *message = module.insert(_scan(arrays, "", sensor), _poses(arrays["guess"])[0])
    return ({"status": status, "message": message[0] if message else ""}, {"pose": pose._row(), "map_lines": [lines]})


def _map(module, arrays, sensor):
    return {}, {"map": _flat(line._row() for line in module.map())}


def _merge(module, arrays, sensor):
    lines = [MapLine((r[0], r[1]), (r[2], r[3]), (r[4], r[5], r[6]), int(r[7]), int(r[8]))
             for r in _rows(arrays["lines"], 9)]
    status, merged, labels, *clusters = module.merge(lines, _rows(arrays["points"], 2))
    result = {"map": _flat(line._row() for line in merged), "labels": labels}
    result.update(zip(("cluster1", "cluster2"), clusters))
    return {"status": status}, result


_CALLS = {"extract": _extract, "match": _match, "align": _align, "insert": _insert, "map": _map, "merge": _merge}


def serve(module_class):
    """Answers the calls of scanbench until it closes the socket."""
    if "SCANBENCH_FD" not in os.environ:
        sys.exit(f"{sys.argv[0]} is a module for scanbench, which starts it. Try: scanbench describe --program "
                 f"python3 {sys.argv[0]}")
    connection = socket.socket(fileno=int(os.environ["SCANBENCH_FD"]))
    module, sensor = None, None
    while True:
        header, arrays = _read(connection)
        sensor = Sensor(header["sensor"]) if "sensor" in header else sensor
        answer, result = {}, {}
        try:
            if header["call"] == "hello":
                answer = {"protocol": PROTOCOL, "params": getattr(module_class, "params", []),
                          **{key: getattr(module_class, key, "") for key in
                             ("kind", "name", "version", "summary", "reference")}}
            elif header["call"] == "make":
                module = module_class(header["params"])
            else:
                answer, result = _CALLS[header["call"]](module, arrays, sensor)
        except MemoryError:
            answer, result = {"error": "MemoryError", "reason": "out_of_memory"}, {}
        except Exception as error:
            traceback.print_exc()
            answer, result = {"error": f"{type(error).__name__}: {error}"}, {}
        sys.stdout.flush()
        _write(connection, {**answer, "id": header["id"]}, result)
