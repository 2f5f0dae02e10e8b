/* Balance control for legged robots. Made from the Rust sources by a test of the crate:
   change those. SUREFOOT_LEGS and SUREFOOT_JOINTS are the robot's, in surefoot_robot.h,
   which is made with the library. */

#ifndef SUREFOOT_H
#define SUREFOOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include "surefoot_robot.h"

/**
 * Words of eight bytes that a controller takes.
 */
#define SUREFOOT_CONTROLLER_WORDS (128 + (32 * SUREFOOT_JOINTS))

/**
 * Version of this header: larger where calls or layouts have changed.
 */
#define SUREFOOT_VERSION_MAJOR 0

/**
 * Version of this header: before 1.0 larger where calls or layouts have changed.
 */
#define SUREFOOT_VERSION_MINOR 1

/**
 * Version of this header: larger where nothing of that has changed.
 */
#define SUREFOOT_VERSION_PATCH 0

/**
 * What became of a call.
 */
typedef enum {
  /**
   * It is done.
   */
  SUREFOOT_STATUS_OK = 0,
  /**
   * A pointer that must not be null is.
   */
  SUREFOOT_STATUS_NULL_POINTER = 1,
  /**
   * The controller was not made by `surefoot_init`, or that has failed.
   */
  SUREFOOT_STATUS_NOT_MADE = 2,
  /**
   * A number of the settings is none that can be used: the period, a gain.
   */
  SUREFOOT_STATUS_BAD_SETTINGS = 3,
  /**
   * Limits are asked for that the robot cannot have: it has no flat soles, or the ground's numbers contradict each
   * other.
   */
  SUREFOOT_STATUS_BAD_LIMITS = 4,
  /**
   * A pose that is not finite, or whose quaternion has not unit length.
   */
  SUREFOOT_STATUS_BAD_POSE = 5,
} surefoot_status;

/**
 * What the supervisor is doing.
 */
typedef enum {
  /**
   * Not asked to do anything: zero torques.
   */
  SUREFOOT_MODE_STANDBY = 0,
  /**
   * Balancing.
   */
  SUREFOOT_MODE_ACTIVE = 1,
  /**
   * Motors brake.
   */
  SUREFOOT_MODE_STOPPING = 2,
  /**
   * Stopped for a reason: zero torques until armed again.
   */
  SUREFOOT_MODE_STOPPED = 3,
} surefoot_mode;

/**
 * Why the supervisor has stopped the robot.
 */
typedef enum {
  /**
   * It has not.
   */
  SUREFOOT_STOP_NONE = 0,
  /**
   * The controller had no answer: an input is no number, or a leg is singular.
   */
  SUREFOOT_STOP_FAULT = 1,
  /**
   * No fresh measurement for too long, or too often.
   */
  SUREFOOT_STOP_STALE = 2,
  /**
   * A tick took longer than its period.
   */
  SUREFOOT_STOP_OVERRUN = 3,
  /**
   * An encoder reads out of its range.
   */
  SUREFOOT_STOP_ENCODER = 4,
  /**
   * An encoder does not follow its rate.
   */
  SUREFOOT_STOP_FROZEN = 5,
  /**
   * An encoder jumps.
   */
  SUREFOOT_STOP_JUMP = 6,
  /**
   * The central body's pose jumps.
   */
  SUREFOOT_STOP_BODY_JUMP = 7,
  /**
   * Measurements do not fit each other.
   */
  SUREFOOT_STOP_DOUBTFUL = 8,
  /**
   * The central body tilts too far.
   */
  SUREFOOT_STOP_TILT = 9,
  /**
   * The central body sinks too far.
   */
  SUREFOOT_STOP_HEIGHT = 10,
  /**
   * The central body falls freely.
   */
  SUREFOOT_STOP_FREE_FALL = 11,
  /**
   * A motor was at its limit for too long.
   */
  SUREFOOT_STOP_SATURATED = 12,
  /**
   * The state's estimate is not to be believed.
   */
  SUREFOOT_STOP_ESTIMATE = 13,
} surefoot_stop;

/**
 * A limit of ground or motors.
 */
typedef enum {
  /**
   * None binds.
   */
  SUREFOOT_LIMIT_NONE = 0,
  /**
   * Least force on a foot.
   */
  SUREFOOT_LIMIT_LIFT = 1,
  /**
   * Greatest force on a foot.
   */
  SUREFOOT_LIMIT_PRESS = 2,
  /**
   * Friction against sliding.
   */
  SUREFOOT_LIMIT_SLIP = 3,
  /**
   * Centre of pressure at the sole's edge.
   */
  SUREFOOT_LIMIT_TIP = 4,
  /**
   * Friction against turning about the normal.
   */
  SUREFOOT_LIMIT_TWIST = 5,
  /**
   * Torque of a joint.
   */
  SUREFOOT_LIMIT_TORQUE = 6,
} surefoot_limit;

/**
 * Constants of a controller. `surefoot_default_settings` gives those of the robot's file.
 */
typedef struct {
  /**
   * Seconds between ticks.
   */
  float period;
  /**
   * Diagonals of the gains: position, 1/s².
   */
  float position_gain[3];
  /**
   * Velocity, 1/s.
   */
  float velocity_gain[3];
  /**
   * Orientation, 1/s².
   */
  float orientation_gain[3];
  /**
   * Angular velocity, 1/s.
   */
  float angular_velocity_gain[3];
  /**
   * Whether the feet's wrenches are kept within what follows, and within the soles and the motors' torques.
   */
  bool is_limited;
  /**
   * Of the ground; the controller uses all of it.
   */
  float friction;
  /**
   * Least force on a foot that touches, N.
   */
  float least_force;
  /**
   * Greatest force on a foot, N.
   */
  float greatest_force;
  /**
   * Share of the soles' lengths that is used, 0 to 1.
   */
  float sole_share;
} surefoot_settings;

/**
 * A controller: memory that belongs to the caller, of which `surefoot_init` makes one. To be looked at by this library
 * alone; it holds no pointer into itself, and may be copied.
 */
typedef struct {
  uint64_t opaque[SUREFOOT_CONTROLLER_WORDS];
} surefoot_controller;

/**
 * A measured state. Joints are those of the robot's file in its order: leg after leg, hip to foot.
 */
typedef struct {
  /**
   * Of the central body's centre of mass, m, world frame.
   */
  float position[3];
  /**
   * World from central body, a unit quaternion, scalar first.
   */
  float orientation[4];
  /**
   * Of the central body in its own axes: of its centre of mass, m/s, and angular, rad/s.
   */
  float velocity[6];
  /**
   * rad
   */
  float joint_angles[SUREFOOT_JOINTS];
  /**
   * rad/s
   */
  float joint_rates[SUREFOOT_JOINTS];
  /**
   * Whether each foot touches the ground; read where limits of the ground are looked at.
   */
  bool feet_touch[SUREFOOT_LEGS];
} surefoot_measurement;

/**
 * What a tick gives. A joint or leg that is of no meaning is 255.
 */
typedef struct {
  /**
   * For the motors, N·m, finite and within the robot's limits in every mode.
   */
  float torques[SUREFOOT_JOINTS];
  /**
   * After the tick.
   */
  surefoot_mode mode;
  /**
   * Why it was stopped.
   */
  surefoot_stop stop;
  /**
   * The joint that the reason names, in the order of torques.
   */
  uint8_t stop_joint;
  /**
   * The limit of ground or motors that costs most, if limits are looked at.
   */
  surefoot_limit limit;
  /**
   * Its leg.
   */
  uint8_t limit_leg;
  /**
   * Its joint, in the order of torques.
   */
  uint8_t limit_joint;
  /**
   * By how much the objective would fall per 100 % of a wider limit.
   */
  float limit_relief;
  /**
   * Whether the tick's work was spent before all limits were kept; torques are cut in any case.
   */
  bool is_unfinished;
  /**
   * How often torques were cut so far.
   */
  uint32_t cut_torques;
} surefoot_command;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Bytes of a controller, for programs that read it when they run.
 */
extern const size_t surefoot_controller_bytes;

/**
 * The same sizes for programs that read them when they run.
 */
extern const size_t surefoot_legs;

/**
 * See `surefoot_legs`.
 */
extern const size_t surefoot_joints;

/**
 * Name of the robot, ends with a zero.
 */
const char *surefoot_robot_name(void);

/**
 * Writes what the robot's file gives: a tick each millisecond, its gains, its pose, limits of ground that are not
 * looked at.
 *
 * # Safety
 * `settings` is null, or may be written to.
 */
surefoot_status surefoot_default_settings(surefoot_settings *settings);

/**
 * Makes a controller in a caller's memory, in standby. To be called before all others, and again for other settings.
 *
 * # Safety
 * `controller` is null, or may be written to; `settings` is null, or may be read.
 */
surefoot_status surefoot_init(surefoot_controller *controller,
                              const surefoot_settings *settings);

/**
 * A pose to hold from the next tick on: where the central body's centre of mass is (m), and its unit quaternion,
 * scalar first.
 *
 * # Safety
 * `controller` is null, or may be written to; the others are null, or point to 3 and 4 numbers.
 */
surefoot_status surefoot_set_pose(surefoot_controller *controller,
                                  const float (*position)[3],
                                  const float (*orientation)[4]);

/**
 * Begins to balance at the next tick.
 *
 * # Safety
 * `controller` is null, or may be written to.
 */
surefoot_status surefoot_arm(surefoot_controller *controller);

/**
 * Zero torques from the next tick on.
 *
 * # Safety
 * `controller` is null, or may be written to.
 */
surefoot_status surefoot_disarm(surefoot_controller *controller);

/**
 * One tick, to be called once a period: from a measurement, or null where none has come, to the torques for the
 * motors. They are finite and within the robot's limits in every mode. Where an error comes back, they are zero.
 *
 * # Safety
 * `controller` and `command` are null, or may be written to; `measurement` is null, or may be read.
 */
surefoot_status surefoot_tick(surefoot_controller *controller,
                              const surefoot_measurement *measurement,
                              surefoot_command *command);

/**
 * Version of the library: `MAJOR << 16 | MINOR << 8 | PATCH`. A program whose header says another major or, before
 * 1.0, another minor number must not call the rest.
 */
uint32_t surefoot_version(void);

/**
 * Version of the library: `MAJOR << 16 | MINOR << 8 | PATCH`. A program whose header says another major or, before
 * 1.0, another minor number must not call the rest.
 */
uint32_t surefoot_version(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SUREFOOT_H */
