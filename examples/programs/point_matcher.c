/* A scan matcher as a program in C: point-to-point ICP (Besl & McKay 1992; Lu & Milios 1997).
 *   cc -O2 -I clients -o point_matcher examples/programs/point_matcher.c -lm */
#include "scanbench.h"

typedef struct {
  double x, y;
} point;

/* The points of the returns of every `step`-th beam; how many there are. */
static int points_of(const sb_scan* scan, int step, point* points) {
  int n = 0;
  for (int i = 0; i < scan->sensor->beams; i += step) {
    const double r = scan->ranges[i], angle = scan->sensor->angle_min_rad + i * scan->sensor->angle_step_rad;
    if (!(r > 0 && r < INFINITY)) continue;
    points[n].x = r * cos(angle);
    points[n++].y = r * sin(angle);
  }
  return n;
}

static point moved(sb_pose pose, point p) {
  const point q = {pose.cos * p.x - pose.sin * p.y + pose.x, pose.sin * p.x + pose.cos * p.y + pose.y};
  return q;
}

/* The nearest of the points; NULL if none is nearer than `reach`. */
static const point* nearest(const point* points, int n, point p, double reach) {
  const point* found = NULL;
  double best = reach * reach;
  for (int i = 0; i < n; ++i) {
    const double dx = points[i].x - p.x, dy = points[i].y - p.y, square = dx * dx + dy * dy;
    if (square < best) best = square, found = &points[i];
  }
  return found;
}

/* The motion of least squares that maps from[i] to to[i]. */
static sb_pose fitted(const point* from, const point* to, int n) {
  point f = {0, 0}, t = {0, 0};
  double dot = 0, cross = 0;
  for (int i = 0; i < n; ++i) {
    f.x += from[i].x / n, f.y += from[i].y / n;
    t.x += to[i].x / n, t.y += to[i].y / n;
  }
  for (int i = 0; i < n; ++i) {
    const double fx = from[i].x - f.x, fy = from[i].y - f.y, tx = to[i].x - t.x, ty = to[i].y - t.y;
    dot += fx * tx + fy * ty;
    cross += fx * ty - fy * tx;
  }
  const double norm = hypot(dot, cross), c = norm > 0 ? dot / norm : 1, s = norm > 0 ? cross / norm : 0;
  const sb_pose pose = {t.x - c * f.x + s * f.y, t.y - s * f.x - c * f.y, c, s};
  return pose;
}

static void match(const sb_scan* reference, const sb_scan* current, sb_pose guess, const double* params,
                  sb_match* result) {
  const size_t bytes = ((size_t)reference->sensor->beams + 1) * sizeof(point);
  point *fixed = (point*)sb_memory(NULL, bytes), *moving = (point*)sb_memory(NULL, bytes);
  point *from = (point*)sb_memory(NULL, bytes), *to = (point*)sb_memory(NULL, bytes);
  const int n = points_of(reference, 1, fixed), m = points_of(current, (int)params[2], moving);
  sb_pose pose = guess;
  result->status = "max_iterations";
  for (int k = 0; k < (int)params[1]; ++k) {
    int pairs = 0;
    for (int i = 0; i < m; ++i) {
      const point* partner = nearest(fixed, n, moved(pose, moving[i]), params[0]);
      if (partner == NULL) continue;
      from[pairs] = moving[i];
      to[pairs++] = *partner;
    }
    if (pairs < 3) {
      result->status = "no_match";
      pose = guess;
      break;
    }
    const sb_pose better = fitted(from, to, pairs);
    const double change = fabs(better.x - pose.x) + fabs(better.y - pose.y) + fabs(better.sin - pose.sin);
    pose = better;
    if (change < 1e-6) {
      result->status = "converged";
      break;
    }
  }
  result->pose = pose;
  free(fixed);
  free(moving);
  free(from);
  free(to);
}

int main(void) {
  static const sb_param params[] = {
      {"max_distance_m", "number", 0.3, 0, INFINITY, 1, "m", "farthest pair"},
      {"iterations", "integer", 30, 1, INFINITY, 0, "", "most iterations"},
      {"every", "integer", 4, 1, INFINITY, 0, "", "of the points of the current scan, one in this many is used"}};
  static const sb_matcher matcher = {"point_matcher_c", "1.0", "point-to-point ICP, in C", "Besl & McKay 1992",
                                     params,            3,     match};
  return sb_serve_matcher(&matcher);
}
