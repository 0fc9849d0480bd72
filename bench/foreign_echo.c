/* A program that is a module and does no work: 100 equal lines for every scan. */
#include "scanbench.h"

static void extract(const sb_scan* scan, const double* params, sb_result* result) {
  (void)params;
  for (int i = 0; i < 100 && 10 * i < scan->sensor->beams; ++i) {
    const int beam = 10 * i;
    const sb_line line = {1, -1, 1, 1, 1, 0, 0, {NAN, NAN, NAN}};
    sb_add_line(result, &line, &beam, 1);
  }
}

int main(void) {
  static const sb_module module = {"echo", "1", "100 lines, whatever the scan", "none", NULL, 0, extract};
  return sb_serve(&module);
}
