/* A client of scanbench: line extractors and scan matchers in C. One file, C99 and POSIX.
 *
 *   static void extract(const sb_scan* scan, const double* params, sb_result* result) { ... sb_add_line(...) ... }
 *
 *   int main(void) {
 *     static const sb_param params[] = {{"min_points", "integer", 2, 2, INFINITY, 0, "", "fewest returns of a line"}};
 *     static const sb_module module = {"my_lines", "1.0", "one line through all returns", "none", params, 1, extract};
 *     return sb_serve(&module);
 *   }
 *
 * A matcher is an sb_matcher, with sb_serve_matcher(). Parameters are numbers, integers and booleans; their values
 * arrive in the order of the list. */
#ifndef SCANBENCH_CLIENT_H
#define SCANBENCH_CLIENT_H

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

typedef struct {
  const char* name;
  const char* type; /* "number", "integer", "boolean" */
  double value;     /* the default */
  double min, max;  /* -INFINITY, INFINITY: none */
  int open_min;     /* min itself is not allowed */
  const char* unit;
  const char* doc;
} sb_param;

/* The sensor's data sheet. Beam i points to angle_min_rad + i * angle_step_rad, sensor frame. */
typedef struct {
  int beams;
  double angle_min_rad, angle_step_rad, range_min_m, range_max_m, sigma_m, sigma_relative;
} sb_sensor;

/* One range in metres per beam: +inf nothing in range, -inf too close, NaN faulty. */
typedef struct {
  const sb_sensor* sensor;
  const double* ranges;
  double stamp_s;
  /* Of a matcher: the lines found in the scan, ten numbers each (docs/plugins.md), per beam the index of its line. */
  const double* line_rows;
  int lines;
  const double* labels;
} sb_scan;

/* A rigid motion: the point (u, v) goes to (cos u - sin v + x, sin u + cos v + y). */
typedef struct {
  double x, y, cos, sin;
} sb_pose;

typedef struct {
  const char* status; /* "converged", "max_iterations", "degenerate", "no_match" */
  sb_pose pose;       /* of the current scan in the frame of the reference; for no_match the guess */
  int has_covariance;
  double covariance[9]; /* of (x, y, yaw), m and rad, by rows */
} sb_match;

/* A line in the sensor frame; free space is on the left of a -> b. */
typedef struct {
  double ax, ay, bx, by;
  double rho, alpha; /* x cos(alpha) + y sin(alpha) = rho, rho >= 0 */
  double rms_m;
  double covariance[3]; /* var(offset), cov, var(angle) at the midpoint; {NAN, NAN, NAN}: not estimated */
} sb_line;

typedef struct {
  double* rows; /* ten numbers per line */
  double* covariances;
  double* labels; /* per beam the index of its line, -1: none */
  int lines, room;
} sb_result;

typedef struct {
  const char *name, *version, *summary, *reference;
  const sb_param* params;
  int param_count;
  void (*extract)(const sb_scan* scan, const double* params, sb_result* result);
} sb_module;

typedef struct {
  const char *name, *version, *summary, *reference;
  const sb_param* params;
  int param_count;
  void (*match)(const sb_scan* reference, const sb_scan* current, sb_pose guess, const double* params,
                sb_match* result);
} sb_matcher;

static inline void sb_fail(const char* what) {
  fprintf(stderr, "scanbench.h: %s\n", what);
  exit(1);
}

static inline void* sb_memory(void* old, size_t bytes) {
  void* memory = realloc(old, bytes > 0 ? bytes : 1);
  if (memory == NULL) sb_fail("out of memory");
  return memory;
}

/* Adds a line that explains the given beams, in ascending order. Lines come in the order of their first beams. */
static inline void sb_add_line(sb_result* result, const sb_line* line, const int* beams, int count) {
  if (result->lines == result->room) {
    result->room = 2 * result->room + 8;
    result->rows = (double*)sb_memory(result->rows, (size_t)result->room * 10 * sizeof(double));
    result->covariances = (double*)sb_memory(result->covariances, (size_t)result->room * 3 * sizeof(double));
  }
  const double row[10] = {line->ax,    line->ay,   line->bx,        line->by,      line->rho,
                          line->alpha, count > 0 ? beams[0] : -1.0, count > 0 ? beams[count - 1] : -1.0,
                          (double)count, line->rms_m};
  memcpy(result->rows + 10 * result->lines, row, sizeof row);
  memcpy(result->covariances + 3 * result->lines, line->covariance, sizeof line->covariance);
  for (int i = 0; i < count; ++i) result->labels[beams[i]] = result->lines;
  ++result->lines;
}

/* JSON: the end of a value, the value of a key of an object; NULL if there is none. */
static inline const char* sb_skip(const char* at) {
  int depth = 0;
  while (*at != '\0') {
    if (*at == '"') {
      for (++at; *at != '"'; ++at) {
        if (*at == '\0') return at;
        if (*at == '\\' && at[1] != '\0') ++at;
      }
    } else if (*at == '{' || *at == '[') {
      ++depth;
    } else if (*at == '}' || *at == ']') {
      if (depth == 0) return at;
      --depth;
    } else if (*at == ',' && depth == 0) {
      return at;
    }
    ++at;
  }
  return at;
}

static inline const char* sb_find(const char* object, const char* key) {
  const size_t length = strlen(key);
  if (object == NULL || *object != '{') return NULL;
  const char* at = object + 1;
  while (*at != '\0' && *at != '}') {
    while (*at == ' ' || *at == ',') ++at;
    const int is_it = *at == '"' && strncmp(at + 1, key, length) == 0 && at[1 + length] == '"';
    if (is_it) {
      at += length + 2;
      while (*at == ' ' || *at == ':') ++at;
      return at;
    }
    at = sb_skip(at);
    if (*at == ']') return NULL;
  }
  return NULL;
}

static inline double sb_number(const char* object, const char* key, double fallback) {
  const char* at = sb_find(object, key);
  if (at == NULL) return fallback;
  if (strncmp(at, "true", 4) == 0) return 1.0;
  if (strncmp(at, "false", 5) == 0) return 0.0;
  return strtod(at, NULL);
}

typedef struct {
  int fd;
  size_t first, end; /* of the bytes that were received and are not yet read */
  char ahead[65536];
} sb_input;

/* 0 at the end of the socket, which is the end of the work. */
static inline int sb_read(sb_input* input, void* to, size_t bytes) {
  char* at = (char*)to;
  while (bytes > 0) {
    const size_t held = input->end - input->first;
    const size_t taken = held < bytes ? held : bytes;
    if (taken > 0) {
      memcpy(at, input->ahead + input->first, taken);
      input->first += taken;
      at += taken;
      bytes -= taken;
      continue;
    }
    const ssize_t n = read(input->fd, input->ahead, sizeof input->ahead);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return 0;
    input->first = 0;
    input->end = (size_t)n;
  }
  return 1;
}

/* Sends a frame, in one piece if the system takes it, which wakes scanbench once. */
static inline void sb_send(int fd, const char* header, const double* const* arrays, const size_t* lengths, int count) {
  char head[16] = {'S', 'B', 'F', '1'};
  struct iovec parts[8] = {{head, sizeof head}, {(void*)header, strlen(header)}};
  const uint32_t length = (uint32_t)strlen(header);
  uint64_t numbers = 0;
  for (int i = 0; i < count; ++i) {
    parts[2 + i].iov_base = (void*)arrays[i];
    parts[2 + i].iov_len = lengths[i] * sizeof(double);
    numbers += lengths[i];
  }
  memcpy(head + 4, &length, 4);
  memcpy(head + 8, &numbers, 8);
  for (int next = 0; next < 2 + count;) {
    ssize_t n = writev(fd, parts + next, 2 + count - next);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) exit(1);
    while (next < 2 + count && (size_t)n >= parts[next].iov_len) n -= (ssize_t)parts[next++].iov_len;
    if (next == 2 + count) return;
    parts[next].iov_base = (char*)parts[next].iov_base + n;
    parts[next].iov_len -= (size_t)n;
  }
}

static inline void sb_hello(int fd, const char* kind, const sb_module* module, long id) {
  char text[16384];
  size_t at = (size_t)snprintf(text, sizeof text,
                               "{\"protocol\":1,\"kind\":\"%s\",\"name\":\"%s\",\"version\":\"%s\",\"summary\":\"%s\","
                               "\"reference\":\"%s\",\"id\":%ld,\"params\":[",
                               kind, module->name, module->version, module->summary, module->reference, id);
  for (int i = 0; i < module->param_count && at < sizeof text; ++i) {
    const sb_param* p = &module->params[i];
    const int truth = strcmp(p->type, "boolean") == 0;
    at += (size_t)snprintf(text + at, sizeof text - at, "%s{\"name\":\"%s\",\"type\":\"%s\",\"unit\":\"%s\",\"doc\":\"%s\",\"open_min\":%s",
                           i > 0 ? "," : "", p->name, p->type, p->unit, p->doc, p->open_min ? "true" : "false");
    if (at < sizeof text && truth)
      at += (size_t)snprintf(text + at, sizeof text - at, ",\"default\":%s", p->value != 0.0 ? "true" : "false");
    if (at < sizeof text && !truth) at += (size_t)snprintf(text + at, sizeof text - at, ",\"default\":%.17g", p->value);
    if (at < sizeof text && isfinite(p->min)) at += (size_t)snprintf(text + at, sizeof text - at, ",\"min\":%.17g", p->min);
    if (at < sizeof text && isfinite(p->max)) at += (size_t)snprintf(text + at, sizeof text - at, ",\"max\":%.17g", p->max);
    if (at < sizeof text) at += (size_t)snprintf(text + at, sizeof text - at, "}");
  }
  if (at + 3 > sizeof text) sb_fail("the description is too long");
  memcpy(text + at, "]}", 3);
  sb_send(fd, text, NULL, NULL, 0);
}

/* The numbers of an array that the header names; NULL if there is none. */
static inline const double* sb_array(const char* header, const double* numbers, const char* name, size_t* length) {
  const char* at = sb_find(header, "arrays");
  const size_t size = strlen(name);
  *length = 0;
  if (at == NULL) return NULL;
  for (at = strchr(at, '"'); at != NULL; at = strchr(at, '"')) {
    const int is_it = strncmp(at + 1, name, size) == 0 && at[1 + size] == '"';
    at = strchr(at + 1, '"');
    char* end = NULL;
    if (at == NULL) return NULL;
    at += strspn(at, "\", ");
    const size_t count = (size_t)strtoul(at, &end, 10);
    if (is_it) {
      *length = count;
      return numbers;
    }
    numbers += count;
    at = end;
    if (end[strspn(end, " ]")] != ',') return NULL; /* the end of the list */
  }
  return NULL;
}

static inline sb_scan sb_scan_of(const char* header, const double* numbers, const char* prefix,
                                 const sb_sensor* sensor) {
  char name[64];
  size_t beams = 0, stamps = 0, lines = 0, labels = 0;
  sb_scan scan = {sensor, NULL, 0, NULL, 0, NULL};
  snprintf(name, sizeof name, "%sranges", prefix);
  scan.ranges = sb_array(header, numbers, name, &beams);
  snprintf(name, sizeof name, "%sstamp_s", prefix);
  const double* stamp = sb_array(header, numbers, name, &stamps);
  snprintf(name, sizeof name, "%slines", prefix);
  scan.line_rows = sb_array(header, numbers, name, &lines);
  snprintf(name, sizeof name, "%slabels", prefix);
  scan.labels = sb_array(header, numbers, name, &labels);
  if (scan.ranges == NULL || stamps != 1 || beams != (size_t)sensor->beams) sb_fail("a call has no scan");
  scan.stamp_s = stamp[0];
  scan.lines = (int)(lines / 10);
  return scan;
}

/* One call: its header and numbers, what is known of the module, and where the answer goes. */
typedef struct {
  int fd;
  long id;
  const char* header;
  const double* numbers;
  const sb_sensor* sensor;
  const double* params;
  sb_result* result;
} sb_call;

static inline void sb_answer_extract(const sb_call* call, const sb_module* module) {
  const int beams = call->sensor->beams;
  const sb_scan scan = sb_scan_of(call->header, call->numbers, "", call->sensor);
  sb_result* result = call->result;
  result->labels = (double*)sb_memory(result->labels, (size_t)beams * sizeof(double));
  for (int i = 0; i < beams; ++i) result->labels[i] = -1.0;
  result->lines = 0;
  module->extract(&scan, call->params, result);
  char answer[256];
  snprintf(answer, sizeof answer, "{\"id\":%ld,\"arrays\":[[\"lines\",%d],[\"covariances\",%d],[\"labels\",%d]]}",
           call->id, 10 * result->lines, 3 * result->lines, beams);
  const double* const arrays[3] = {result->rows, result->covariances, result->labels};
  const size_t lengths[3] = {10 * (size_t)result->lines, 3 * (size_t)result->lines, (size_t)beams};
  fflush(stdout);
  sb_send(call->fd, answer, arrays, lengths, 3);
}

static inline void sb_answer_match(const sb_call* call, const sb_matcher* module) {
  const sb_scan reference = sb_scan_of(call->header, call->numbers, "reference.", call->sensor);
  const sb_scan current = sb_scan_of(call->header, call->numbers, "current.", call->sensor);
  size_t four = 0;
  const double* row = sb_array(call->header, call->numbers, "guess", &four);
  if (four != 4) sb_fail("a call has no guess");
  const sb_pose guess = {row[0], row[1], row[2], row[3]};
  sb_match match = {"no_match", guess, 0, {0}};
  module->match(&reference, &current, guess, call->params, &match);
  const double pose[4] = {match.pose.x, match.pose.y, match.pose.cos, match.pose.sin};
  const size_t lengths[2] = {4, 9};
  char answer[256];
  snprintf(answer, sizeof answer, "{\"id\":%ld,\"status\":\"%s\",\"arrays\":[[\"pose\",4]%s]}", call->id, match.status,
           match.has_covariance ? ",[\"covariance\",9]" : "");
  const double* const arrays[2] = {pose, match.covariance};
  fflush(stdout);
  sb_send(call->fd, answer, arrays, lengths, match.has_covariance ? 2 : 1);
}

/* Answers the calls of scanbench until it closes the socket. `module` describes the program; `matcher`: NULL, or what
 * it is instead of an extractor. */
static inline int sb_serve_kind(const sb_module* module, const sb_matcher* matcher) {
  const char* kind = matcher != NULL ? "match" : "extract";
  const char* number = getenv("SCANBENCH_FD");
  if (number == NULL) sb_fail("this program is a module for scanbench, which starts it");
  const int fd = atoi(number);
  static sb_input input;
  input.fd = fd;
  char* header = NULL;
  double* numbers = NULL;
  double* params = (double*)sb_memory(NULL, (size_t)module->param_count * sizeof(double));
  for (int i = 0; i < module->param_count; ++i) params[i] = module->params[i].value;
  sb_sensor sensor = {0};
  sb_result result = {0};
  char head[16];
  while (sb_read(&input, head, sizeof head)) {
    uint32_t length = 0;
    uint64_t count = 0;
    memcpy(&length, head + 4, 4);
    memcpy(&count, head + 8, 8);
    if (memcmp(head, "SBF1", 4) != 0) sb_fail("this is not a frame of the protocol");
    header = (char*)sb_memory(header, (size_t)length + 1);
    numbers = (double*)sb_memory(numbers, (size_t)count * sizeof(double));
    if (!sb_read(&input, header, length) || !sb_read(&input, numbers, (size_t)count * sizeof(double))) break;
    header[length] = '\0';
    const char* name = sb_find(header, "call");
    const char* sheet = sb_find(header, "sensor");
    const sb_call call = {fd, (long)sb_number(header, "id", 0), header, numbers, &sensor, params, &result};
    if (name == NULL) sb_fail("a call has no name");
    if (sheet != NULL) {
      sensor.beams = (int)sb_number(sheet, "beams", 0);
      sensor.angle_min_rad = sb_number(sheet, "angle_min_rad", 0);
      sensor.angle_step_rad = sb_number(sheet, "angle_step_rad", 0);
      sensor.range_min_m = sb_number(sheet, "range_min_m", 0);
      sensor.range_max_m = sb_number(sheet, "range_max_m", 0);
      sensor.sigma_m = sb_number(sheet, "sigma_m", 0);
      sensor.sigma_relative = sb_number(sheet, "sigma_relative", 0);
    }
    if (strncmp(name, "\"hello\"", 7) == 0) {
      sb_hello(fd, kind, module, call.id);
    } else if (strncmp(name, "\"make\"", 6) == 0) {
      const char* values = sb_find(header, "params");
      for (int i = 0; i < module->param_count; ++i)
        params[i] = sb_number(values, module->params[i].name, module->params[i].value);
      char answer[64];
      snprintf(answer, sizeof answer, "{\"id\":%ld}", call.id);
      sb_send(fd, answer, NULL, NULL, 0);
    } else if (strncmp(name + 1, kind, strlen(kind)) != 0 || name[1 + strlen(kind)] != '"') {
      sb_fail("an unknown call");
    } else if (matcher != NULL) {
      sb_answer_match(&call, matcher);
    } else {
      sb_answer_extract(&call, module);
    }
  }
  return 0;
}

/* These answer the calls of scanbench until it closes the socket, and return the exit code of the program. */
static inline int sb_serve(const sb_module* module) {
  return sb_serve_kind(module, NULL);
}

static inline int sb_serve_matcher(const sb_matcher* matcher) {
  const sb_module module = {matcher->name,   matcher->version,     matcher->summary, matcher->reference,
                            matcher->params, matcher->param_count, NULL};
  return sb_serve_kind(&module, matcher);
}

#endif
