/* Balances once a millisecond: here for three ticks of a robot that stands still, told by the caller.
 *
 *   cc -I DIR balance.c DIR/libsurefoot_c.a -lm -lpthread -ldl -o balance && ./balance X Y Z ANGLE...
 *
 * where DIR is what `cargo xtask c` printed, X Y Z is where the central body is (m), and the angles are those of all
 * joints (rad). It prints the torques of each tick as hexadecimal numbers, which have the bits.
 */
#include <stdio.h>
#include <stdlib.h>

#include "surefoot.h"

int main(int count, char **words) {
    if (count != 4 + SUREFOOT_JOINTS) {
        fprintf(stderr, "usage: %s X Y Z and %d joint angles\n", words[0], SUREFOOT_JOINTS);
        return 2;
    }
    surefoot_settings settings;
    surefoot_default_settings(&settings);
    settings.is_limited = true;
    static surefoot_controller controller;
    surefoot_status status = surefoot_init(&controller, &settings);
    if (status != SUREFOOT_STATUS_OK) {
        fprintf(stderr, "%s: no controller, status %d\n", surefoot_robot_name(), (int)status);
        return 1;
    }
    surefoot_measurement measured = {.orientation = {1.0f, 0.0f, 0.0f, 0.0f}};
    for (int i = 0; i < 3; i++) {
        measured.position[i] = strtof(words[1 + i], NULL);
    }
    for (int i = 0; i < SUREFOOT_JOINTS; i++) {
        measured.joint_angles[i] = strtof(words[4 + i], NULL);
    }
    for (int i = 0; i < SUREFOOT_LEGS; i++) {
        measured.feet_touch[i] = true;
    }
    surefoot_arm(&controller);
    for (int tick = 0; tick < 3; tick++) {
        surefoot_command command;
        status = surefoot_tick(&controller, &measured, &command);
        if (status != SUREFOOT_STATUS_OK || command.mode != SUREFOOT_MODE_ACTIVE) {
            fprintf(stderr, "status %d, mode %d, stop %d\n", (int)status, (int)command.mode, (int)command.stop);
            return 1;
        }
        for (int i = 0; i < SUREFOOT_JOINTS; i++) {
            printf("%a ", command.torques[i]);
        }
        printf("\n");
    }
    return 0;
}
