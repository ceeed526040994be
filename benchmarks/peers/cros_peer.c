/* One side of a benchmark, with cROS: MODE messages=DIR name=value ..., as every peer here.
 *
 * cROS has one message under way at a time: sending returns when it is in the socket. Headers
 * stay as they are, which is some bytes less than the others send.
 */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "cros.h"

#define HOST "127.0.0.1"
#define IDLE 3.0     /* seconds without a message: the rest is lost */
#define CONNECT 1000 /* ms for the other side to connect: nothing tells when it has */
#define WAIT 5000    /* ms for anything else */

static int argument_count;
static char **arguments;
static CrosNode *node;
static unsigned char stop;
static long received;
static double first, last, used;
static cRosMessage *outgoing;
static int outgoing_index;

static const char *text(const char *name) {
  const size_t length = strlen(name);
  for (int i = 2; i < argument_count; ++i) {
    if (!strncmp(arguments[i], name, length) && arguments[i][length] == '=') {
      return arguments[i] + length + 1;
    }
  }
  return "";
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

static void check(cRosErrCodePack result, const char *what) {
  if (result != CROS_SUCCESS_ERR_PACK) {
    fprintf(stderr, "%s failed\n", what);
    exit(1);
  }
}

static cRosMessageField *field(cRosMessage *message, const char *name) {
  cRosMessageField *found = cRosMessageGetField(message, name);
  if (!found) {
    fprintf(stderr, "no field %s\n", name);
    exit(1);
  }
  return found;
}

static const char *type(void) {
  const char *kind = text("kind");
  if (!strcmp(kind, "JointState")) return "sensor_msgs/JointState";
  if (!strcmp(kind, "TransformStamped")) return "geometry_msgs/TransformStamped";
  if (!strcmp(kind, "PointCloud2")) return "sensor_msgs/PointCloud2";
  return "std_msgs/String";
}

static void fill(cRosMessage *message) {
  const char *kind = text("kind");
  const size_t size = (size_t)atol(text("size"));
  if (!strcmp(kind, "String")) {
    char *data = malloc(size + 1);
    memset(data, 'x', size);
    data[size] = 0;
    cRosMessageSetFieldValueString(field(message, "data"), data);
    free(data);
  } else if (!strcmp(kind, "JointState")) {
    for (int i = 0; i < 6; ++i) {
      char name[16];
      snprintf(name, sizeof name, "joint_%d", i);
      cRosMessageFieldArrayPushBackString(field(message, "name"), name);
      cRosMessageFieldArrayPushBackFloat64(field(message, "position"), 0.5);
      cRosMessageFieldArrayPushBackFloat64(field(message, "velocity"), 0.5);
      cRosMessageFieldArrayPushBackFloat64(field(message, "effort"), 0.5);
    }
  } else if (!strcmp(kind, "TransformStamped")) {
    cRosMessageSetFieldValueString(field(message, "child_frame_id"), "base_link");
    cRosMessage *transform = field(message, "transform")->data.as_msg;
    field(field(transform, "rotation")->data.as_msg, "w")->data.as_float64 = 1.0;
  } else {
    for (size_t i = 0; i < size; ++i) {
      cRosMessageFieldArrayPushBackUInt8(field(message, "data"), 0);
    }
  }
}

static const char *resolve(const char *name) {
  static char names[4][256];
  static int next;
  char *result = names[next++ % 4];
  snprintf(result, sizeof names[0], "%s/%s", getenv("ROS_NAMESPACE"), name);
  return result;
}

static void run(unsigned long milliseconds) { cRosNodeStart(node, milliseconds, &stop); }

static void advertise(const char *name) {
  check(cRosApiRegisterPublisher(node, resolve(name), type(), -1, NULL, NULL, NULL,
                                 &outgoing_index),
        "registering a publisher");
  outgoing = cRosApiCreatePublisherMessage(node, outgoing_index);
}

static void subscribe(const char *name, SubscriberApiCallback callback) {
  int index;
  check(cRosApiRegisterSubscriber(node, resolve(name), type(), callback, NULL, NULL, 1, &index),
        "registering a subscriber");
}

static void publish(void) {
  check(cRosNodeSendTopicMsg(node, outgoing_index, outgoing, WAIT), "publishing");
}

static CallbackResponse count_one(cRosMessage *message, void *context) {
  (void)message, (void)context;
  last = now();
  if (!received++) {
    first = last;
    used = cpu();
  }
  if (received == atol(text("count"))) stop = 1;
  return 0;
}

static CallbackResponse wake(cRosMessage *message, void *context) {
  (void)message, (void)context;
  stop = 1;
  return 0;
}

static CallbackResponse take_over(cRosMessage *message, void *context) {
  (void)context;
  cRosMessageSetFieldValueString(field(outgoing, "data"), field(message, "data")->data.as_string);
  stop = 1;
  return 0;
}

static void pub(void) {
  const long count = atol(text("count"));
  advertise("benchmark");
  fill(outgoing);
  run(CONNECT);
  const double begun_cpu = cpu(), start = now();
  for (long i = 0; i < count; ++i) publish();
  const double spent = cpu() - begun_cpu, seconds = now() - start;
  run(CONNECT); /* for what may not have been sent yet */
  printf("{\"cpu\": %.6f, \"seconds\": %.9f, \"rss\": %ld}\n", spent, seconds, peak_memory());
}

static void sub(void) {
  subscribe("benchmark", count_one);
  printf("{\"ready\": 1}\n");
  fflush(stdout);
  while (!stop && !(received && now() - last > IDLE)) run(200);
  printf("{\"received\": %ld, \"seconds\": %.9f, \"cpu\": %.6f, \"rss\": %ld}\n", received,
         last - first, cpu() - used, peak_memory());
}

static int by_value(const void *a, const void *b) {
  const double difference = *(const double *)a - *(const double *)b;
  return (difference > 0) - (difference < 0);
}

static void report_times(double *times, long count) {
  double sum = 0;
  for (long i = 0; i < count; ++i) sum += times[i];
  qsort(times, (size_t)count, sizeof *times, by_value);
  printf("{\"count\": %ld, \"seconds\": %.9f, \"p50\": %.3f, \"p99\": %.3f}\n", count, sum,
         times[count / 2] * 1e6, times[count * 99 / 100] * 1e6);
}

static void ping(void) {
  const long count = atol(text("count")), warm_up = count / 10;
  double *times = malloc((size_t)(count + warm_up) * sizeof *times);
  advertise("ping");
  fill(outgoing);
  subscribe("pong", wake);
  run(CONNECT);
  for (long i = 0; i < count + warm_up; ++i) {
    const double start = now();
    stop = 0;
    publish();
    if (!stop) run(WAIT);
    if (!stop) {
      fprintf(stderr, "no answer\n");
      exit(1);
    }
    times[i] = now() - start;
  }
  report_times(times + warm_up, count);
}

static void pong(void) {
  advertise("pong");
  subscribe("ping", take_over);
  for (;;) {
    stop = 0;
    run(CROS_INFINITE_TIMEOUT);
    publish();
  }
}

static CallbackResponse flip(cRosMessage *request, cRosMessage *response, void *context) {
  (void)context;
  field(response, "success")->data.as_uint8 = field(request, "data")->data.as_uint8;
  cRosMessageSetFieldValueString(field(response, "message"), "ok");
  return 0;
}

static void serve(void) {
  check(cRosApiRegisterServiceProvider(node, resolve("flip"), "std_srvs/SetBool", flip, NULL, NULL,
                                       NULL),
        "registering a service");
  run(CROS_INFINITE_TIMEOUT);
}

static void found(int id, LookupServiceResult *result, void *context) {
  (void)id;
  *(int *)context = result && result->code == 1;
  stop = 1;
}

static void call(void) {
  const long count = atol(text("count")), warm_up = count / 10;
  double *times = malloc((size_t)(count + warm_up) * sizeof *times);
  int there = 0, id, index;
  while (!there) {
    stop = 0;
    check(cRosApiLookupService(node, resolve("flip"), found, &there, &id), "looking up");
    run(WAIT);
    stop = 0;
    if (!there) run(20);
  }
  check(cRosApiRegisterServiceCaller(node, resolve("flip"), "std_srvs/SetBool", -1, NULL, NULL,
                                     NULL, atoi(text("persistent")), 1, &index),
        "registering a caller");
  cRosMessage *request = cRosApiCreateServiceCallerRequest(node, index), response;
  cRosMessageInit(&response);
  field(request, "data")->data.as_uint8 = 1;
  run(200);
  for (long i = 0; i < count + warm_up; ++i) {
    const double start = now();
    check(cRosNodeServiceCall(node, index, request, &response, WAIT), "calling");
    times[i] = now() - start;
  }
  if (!field(&response, "success")->data.as_uint8) exit(1);
  report_times(times + warm_up, count);
}

int main(int argc, char **argv) {
  if (argc < 2) return 2;
  argument_count = argc;
  arguments = argv;
  cRosOutStreamSet(stderr);
  const char *mode = argv[1], *colon = strrchr(getenv("ROS_MASTER_URI"), ':');
  const unsigned short port = (unsigned short)atoi(colon + 1);
  node = cRosNodeCreate(resolve(mode), HOST, HOST, port, text("messages"));
  if (!node) return 1;
  check(cRosWaitPortOpen(HOST, port, WAIT), "finding the master");
  if (!strcmp(mode, "pub")) pub();
  if (!strcmp(mode, "sub")) sub();
  if (!strcmp(mode, "ping")) ping();
  if (!strcmp(mode, "pong")) pong();
  if (!strcmp(mode, "serve")) serve();
  if (!strcmp(mode, "call")) call();
  fflush(stdout);
  cRosNodeDestroy(node);
  return 0;
}
