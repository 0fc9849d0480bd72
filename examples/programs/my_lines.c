/* The example of README.md, one line through all returns, as a program in C:
 *   cc -O2 -I clients -o my_lines examples/programs/my_lines.c -lm */
#include "scanbench.h"

typedef struct {
  double x, y;
} point;

static const double kHalfTurn = 3.14159265358979323846;

static point point_of(const sb_scan* scan, int beam) {
  const double angle = scan->sensor->angle_min_rad + beam * scan->sensor->angle_step_rad;
  const point p = {scan->ranges[beam] * cos(angle), scan->ranges[beam] * sin(angle)};
  return p;
}

static point foot(point p, point mean, point direction) {
  const double t = (p.x - mean.x) * direction.x + (p.y - mean.y) * direction.y;
  const point f = {mean.x + t * direction.x, mean.y + t * direction.y};
  return f;
}

static void extract(const sb_scan* scan, const double* params, sb_result* result) {
  int* beams = (int*)sb_memory(NULL, (size_t)scan->sensor->beams * sizeof(int));
  int n = 0;
  point mean = {0, 0};
  for (int i = 0; i < scan->sensor->beams; ++i) {
    if (!(scan->ranges[i] > 0 && scan->ranges[i] < INFINITY)) continue;
    const point p = point_of(scan, i);
    mean.x += p.x;
    mean.y += p.y;
    beams[n++] = i;
  }
  double xx = 0, yy = 0, xy = 0, square = 0;
  mean.x /= n;
  mean.y /= n;
  for (int i = 0; i < n; ++i) {
    const point p = point_of(scan, beams[i]);
    xx += (p.x - mean.x) * (p.x - mean.x);
    yy += (p.y - mean.y) * (p.y - mean.y);
    xy += (p.x - mean.x) * (p.y - mean.y);
  }
  if (n >= params[0] && xx + yy > 0) {
    const double angle = 0.5 * atan2(2 * xy, xx - yy);
    const point d = {cos(angle), sin(angle)};
    point a = foot(point_of(scan, beams[0]), mean, d), b = foot(point_of(scan, beams[n - 1]), mean, d);
    if (a.x * b.y - a.y * b.x < 0) { /* the sensor is on the left of a -> b */
      const point c = a;
      a = b;
      b = c;
    }
    double rho = mean.y * d.x - mean.x * d.y, nx = -d.y, ny = d.x;
    if (rho < 0) rho = -rho, nx = -nx, ny = -ny;
    for (int i = 0; i < n; ++i) {
      const point p = point_of(scan, beams[i]);
      square += (nx * p.x + ny * p.y - rho) * (nx * p.x + ny * p.y - rho) / n;
    }
    const double alpha = atan2(ny, nx);
    const sb_line line = {a.x, a.y, b.x, b.y, rho, alpha <= -kHalfTurn ? kHalfTurn : alpha, sqrt(square), {NAN, NAN, NAN}};
    sb_add_line(result, &line, beams, n);
  }
  free(beams);
}

int main(void) {
  static const sb_param params[] = {{"min_points", "integer", 2, 2, INFINITY, 0, "", "fewest returns that make a line"}};
  static const sb_module module = {"my_lines_c", "1.0", "one line through all returns", "none", params, 1, extract};
  return sb_serve(&module);
}
