/* A haptic device as a shared library that Cleft finds at run time, in C.
 *
 * Build NAME.so with one exported function, cleft_device(), and put it into <prefix>/lib/cleft/devices or
 * into a folder of the environment variable CLEFT_DEVICES. Then `cleft haptic --device NAME` and the
 * explorer's menu have it, and `cleft haptic --list-devices` says so, or why it cannot be used.
 *
 * Lengths are in mm, forces in N, times in s. Positions and directions are in the mesh's right-handed
 * coordinates. No exception may leave a function. */
#ifndef CLEFT_DEVICES_PLUGIN_H
#define CLEFT_DEVICES_PLUGIN_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface. A plug-in of another version is refused. */
#define CLEFT_DEVICE_VERSION 1

typedef struct cleft_device_pose {
  double tip[3];  /* mm, of the blade */
  double axis[3]; /* unit vector from the tip along the blade to the handle */
  double edge[3]; /* unit vector across the axis, the way the edge cuts */
  int cutting;    /* 1: the blade may cut (a button), else 0 */
  int present;    /* 0: the device is unplugged; there is neither contact nor force */
} cleft_device_pose;

/* What the device renders stably. */
typedef struct cleft_device_limits {
  double max_force;     /* N, above 0 */
  double max_stiffness; /* N/mm, above 0 */
  double max_damping;   /* N s/mm, at least 0 */
  double latency;       /* s from a pose to the force that answers it, beyond the loop's tick; at least 0 */
} cleft_device_limits;

typedef struct cleft_device_plugin {
  unsigned version;  /* CLEFT_DEVICE_VERSION; the first member in every version */
  const char* name;  /* NAME of the file NAME.so */
  const char* title; /* in menus */
  const char* help;  /* one sentence, without a full stop */

  /* Opens the device; the blade begins at `start`. Returns its handle, which all other functions get. Where
   * it cannot be opened: returns null, and writes into `error`, of `size` bytes with the final zero, what is
   * missing and what to do about it. */
  void* (*open)(const cleft_device_pose* start, char* error, size_t size);

  /* The pose at `time`, s since the loop began. Called 1000 times a second from the haptic thread: it neither
   * blocks nor allocates memory. A device that has to wait reads on a thread of its own. */
  void (*read)(void* device, double time, cleft_device_pose* pose);

  /* The force on the hand from now on, N, never above max_force. Called after every read(), from the same
   * thread: it neither blocks nor allocates memory. */
  void (*command)(void* device, const double force[3]);

  /* Constant while the device is open. */
  void (*limits)(void* device, cleft_device_limits* limits);

  /* Ends the forces and frees the device. No read() or command() is under way, and none follows. */
  void (*close)(void* device);
} cleft_device_plugin;

/* The entry point, exported by the shared library. What it returns stays valid while the library is loaded.
 */
const cleft_device_plugin* cleft_device(void);

#ifdef __cplusplus
}
#endif
#endif
