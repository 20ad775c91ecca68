/* A device plug-in for the tests: a simulated arm that moves to where the test pushes it. In C, as plugin.h
 * is. CLEFT_BENCH_VERSION makes it one of another version of the interface. */
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>

#include "haptic/devices/plugin.h"

#ifndef CLEFT_BENCH_VERSION
#define CLEFT_BENCH_VERSION CLEFT_DEVICE_VERSION
#endif

static _Atomic double pushed, felt;
static atomic_int pressed, plugged = 1;

/* What the test does. */
void bench_push(double part) { pushed = part; }
void bench_press(int down) { pressed = down; }
void bench_plug(int in) { plugged = in; }
double bench_felt(void) { return felt; }

static struct arm {
  cleft_device_pose start;
  double time, moved; /* s, mm */
} the_arm;

static void* open_arm(const cleft_device_pose* start, char* error, size_t size) {
  if (!plugged) {
    snprintf(error, size, "the arm is not there: plug the bench in");
    return NULL;
  }
  the_arm = (struct arm){.start = *start};
  return &the_arm;
}

static void read_arm(void* device, double time, cleft_device_pose* pose) {
  struct arm* arm = device;
  const double wanted = 10 * pushed, step = 100 * (time - arm->time); /* 100 mm/s */
  if (wanted > arm->moved) arm->moved = fmin(arm->moved + step, wanted);
  if (wanted < arm->moved) arm->moved = fmax(arm->moved - step, wanted);
  arm->time = time;
  *pose = arm->start;
  pose->tip[0] += isnan(wanted) ? wanted : arm->moved;
  pose->cutting = pressed;
  pose->present = plugged;
}

static void command_arm(void* device, const double force[3]) {
  (void)device;
  felt = force[2];
}

static void limits_of_arm(void* device, cleft_device_limits* limits) {
  (void)device;
  *limits = (cleft_device_limits){3.3, 0.4, 0.004, 0};
}

static void close_arm(void* device) {
  (void)device;
  felt = 0;
}

const cleft_device_plugin* cleft_device(void) {
  static const cleft_device_plugin plugin = {
      CLEFT_BENCH_VERSION, "bench",       "The &bench's arm", "an arm that tests pretend", open_arm, read_arm,
      command_arm,         limits_of_arm, close_arm};
  return &plugin;
}
