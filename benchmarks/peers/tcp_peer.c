/* One side of a benchmark, with nothing but a socket: MODE name=value ..., as every peer here.
 *
 * Frames as TCPROS has them, a length and that many bytes, one send for each; no message is
 * made of them. It is what the machine can do, not what a library could.
 */

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

static int argument_count;
static char **arguments;

static const char *text(const char *name) {
  const size_t length = strlen(name);
  for (int i = 2; i < argument_count; ++i) {
    if (!strncmp(arguments[i], name, length) && arguments[i][length] == '=') {
      return arguments[i] + length + 1;
    }
  }
  return "0";
}

/* The bytes of a message that are not its payload. */
static size_t overhead(const char *kind) {
  if (!strcmp(kind, "String")) return 4;
  if (!strcmp(kind, "JointState")) return 25 + 4 + 6 * 11 + 3 * (4 + 6 * 8);
  if (!strcmp(kind, "TransformStamped")) return 20 + 13 + 7 * 8;
  if (!strcmp(kind, "PointCloud2")) return 22 + 8 + 4 + 1 + 8 + 4 + 1;
  return 22 + 8 + 4 + 1 + 4 + 4; /* Image */
}

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec + time.tv_nsec / 1e9;
}

static double cpu(void) {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
         (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) / 1e6;
}

/* The most memory there was, in bytes. */
static long peak_memory(void) {
  char line[256];
  long peak = 0;
  FILE *status = fopen("/proc/self/status", "r");
  while (status && !peak && fgets(line, sizeof line, status)) {
    if (!strncmp(line, "VmHWM:", 6)) peak = atol(line + 6) * 1024;
  }
  if (status) fclose(status);
  return peak;
}

static void fail(const char *what) {
  perror(what);
  exit(1);
}

static void no_delay(int fd) {
  const int on = 1;
  setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

static struct sockaddr_in address(void) {
  struct sockaddr_in result;
  memset(&result, 0, sizeof result);
  result.sin_family = AF_INET;
  result.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  result.sin_port = htons((uint16_t)atoi(getenv("BENCHMARK_TCP_PORT")));
  return result;
}

static int accept_one(void) {
  const int on = 1;
  struct sockaddr_in where = address();
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (bind(listener, (struct sockaddr *)&where, sizeof where)) fail("bind");
  if (listen(listener, 1)) fail("listen");
  const int fd = accept(listener, NULL, NULL);
  if (fd < 0) fail("accept");
  close(listener);
  no_delay(fd);
  return fd;
}

static int connect_to(void) {
  struct sockaddr_in where = address();
  for (int i = 0; i < 6000; ++i) {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    if (!connect(fd, (struct sockaddr *)&where, sizeof where)) {
      no_delay(fd);
      return fd;
    }
    close(fd);
    usleep(10000);
  }
  fail("connect");
  return -1;
}

static void send_all(int fd, const char *data, size_t size) {
  while (size) {
    const ssize_t sent = send(fd, data, size, 0);
    if (sent <= 0) fail("send");
    data += sent;
    size -= (size_t)sent;
  }
}

/* False at the end of the stream. */
static int receive_all(int fd, char *data, size_t size) {
  while (size) {
    const ssize_t got = recv(fd, data, size, 0);
    if (got <= 0) return 0;
    data += got;
    size -= (size_t)got;
  }
  return 1;
}

static void pub(char *frame, size_t size, long count) {
  const int fd = connect_to();
  const double used = cpu(), start = now();
  for (long i = 0; i < count; ++i) send_all(fd, frame, size);
  printf("{\"cpu\": %.6f, \"seconds\": %.9f, \"rss\": %ld}\n", cpu() - used, now() - start,
         peak_memory());
  shutdown(fd, SHUT_WR);
  recv(fd, frame, 1, 0); /* until the other side has read it all */
}

static void sub(size_t size) {
  const size_t room = size > (1 << 18) ? size : 1 << 18;
  char *buffer = malloc(room);
  const int fd = accept_one();
  size_t filled = 0;
  long received = 0;
  double used = 0, first = 0, last = 0;
  for (;;) {
    const ssize_t got = recv(fd, buffer + filled, room - filled, 0);
    if (got <= 0) break;
    filled += (size_t)got;
    size_t at = 0;
    for (;;) {
      uint32_t length;
      if (filled - at < 4) break;
      memcpy(&length, buffer + at, 4);
      if (filled - at < 4 + (size_t)length) break;
      at += 4 + (size_t)length;
      if (!received++) {
        first = now();
        used = cpu();
      }
    }
    if (at) {
      last = now();
      memmove(buffer, buffer + at, filled - at);
      filled -= at;
    }
  }
  printf("{\"received\": %ld, \"seconds\": %.9f, \"cpu\": %.6f, \"rss\": %ld}\n", received,
         last - first, cpu() - used, peak_memory());
}

static int by_value(const void *a, const void *b) {
  const double difference = *(const double *)a - *(const double *)b;
  return (difference > 0) - (difference < 0);
}

static void ping(char *frame, size_t size, long count) {
  const int fd = connect_to();
  const long warm_up = count / 10;
  double *times = malloc((size_t)(count + warm_up) * sizeof *times), sum = 0;
  char *answer = malloc(size);
  for (long i = 0; i < count + warm_up; ++i) {
    const double start = now();
    send_all(fd, frame, size);
    if (!receive_all(fd, answer, size)) fail("recv");
    times[i] = now() - start;
  }
  times += warm_up;
  for (long i = 0; i < count; ++i) sum += times[i];
  qsort(times, (size_t)count, sizeof *times, by_value);
  printf("{\"count\": %ld, \"seconds\": %.9f, \"p50\": %.3f, \"p99\": %.3f}\n", count, sum,
         times[count / 2] * 1e6, times[count * 99 / 100] * 1e6);
}

static void pong(char *frame, size_t size) {
  const int fd = accept_one();
  while (receive_all(fd, frame, size)) send_all(fd, frame, size);
}

int main(int argc, char **argv) {
  if (argc < 2) return 2;
  argument_count = argc;
  arguments = argv;
  const long count = atol(text("count"));
  const uint32_t length = (uint32_t)((size_t)atol(text("size")) + overhead(text("kind")));
  const size_t size = 4 + (size_t)length;
  char *frame = calloc(1, size);
  memcpy(frame, &length, 4);
  if (!strcmp(argv[1], "pub")) pub(frame, size, count);
  if (!strcmp(argv[1], "sub")) sub(size);
  if (!strcmp(argv[1], "ping")) ping(frame, size, count);
  if (!strcmp(argv[1], "pong")) pong(frame, size);
  return 0;
}
