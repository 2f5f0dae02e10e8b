/* Balances in a timer's interrupt on a bare Cortex-M4F: no operating system, no library of C. The robot stands still
 * here, measured by nobody; put your sensors and motors where it says so.
 *
 * Runs in QEMU as it stands (docs/c.md). It prints the torques of three ticks as the bits of their numbers, and ends.
 */
#include "surefoot.h"

#define WORD(address) (*(volatile uint32_t *)(address))

/* SysTick (ARMv7-M architecture, B3.3) and UART 0 of Arm's CMSDK (DDI 0479, section 4.3). */
#define SYSTICK_CONTROL WORD(0xe000e010)
#define SYSTICK_RELOAD WORD(0xe000e014)
#define UART_DATA WORD(0x40004000)
#define UART_STATE WORD(0x40004004)
#define UART_CONTROL WORD(0x40004008)
#define UART_DIVIDER WORD(0x40004010)

enum { CLOCK_HZ = 25000000, TICKS = 3 };

static surefoot_controller controller;
static surefoot_measurement measured;
static volatile uint32_t ticks;
static surefoot_command commands[TICKS];
static volatile surefoot_status last;

/* Once a millisecond. Nothing else calls the controller while this may run. */
void SysTick_Handler(void) {
    if (ticks < TICKS) {
        /* Sensors: fill `measured`, or pass a null pointer where nothing new has come. */
        last = surefoot_tick(&controller, &measured, &commands[ticks]);
        /* Motors: commands[ticks].torques, N m, finite and within limits whatever `last` says. */
        ticks++;
    }
}

static void print(const char *text) {
    for (; *text != 0; text++) {
        while (UART_STATE & 1) {
        }
        UART_DATA = (uint32_t)*text;
    }
}

static void print_bits(float number) {
    union {
        float number;
        uint32_t bits;
    } as = {number};
    char digits[10] = "00000000 ";
    for (int i = 0; i < 8; i++) {
        digits[7 - i] = "0123456789abcdef"[as.bits >> 4 * i & 15];
    }
    print(digits);
}

/* On bent legs, from hip to foot, degrees. */
static const float leg[6] = {0.0f, 25.1202f, 0.0f, -61.6617f, 0.0f, 36.5415f};

int main(void) {
    UART_DIVIDER = 16;
    UART_CONTROL = 1;
    if (surefoot_version() >> 8 != (SUREFOOT_VERSION_MAJOR << 8 | SUREFOOT_VERSION_MINOR)) {
        print("the header is of another version than the library\n");
        return 1;
    }
    surefoot_settings settings;
    surefoot_default_settings(&settings);
    settings.is_limited = true;
    if (surefoot_init(&controller, &settings) != SUREFOOT_STATUS_OK) {
        print("no controller\n");
        return 1;
    }
    measured.position[0] = -0.01f;
    measured.position[2] = 1.1f;
    measured.orientation[0] = 1.0f;
    for (int joint = 0; joint < SUREFOOT_JOINTS; joint++) {
        measured.joint_angles[joint] = leg[joint % 6] * (3.14159265f / 180.0f);
    }
    for (int foot = 0; foot < SUREFOOT_LEGS; foot++) {
        measured.feet_touch[foot] = true;
    }
    surefoot_arm(&controller);

    SYSTICK_RELOAD = CLOCK_HZ / 1000 - 1;
    SYSTICK_CONTROL = 7; /* the core's clock, interrupt, on */
    while (ticks < TICKS) {
    }
    SYSTICK_CONTROL = 0;
    for (int tick = 0; tick < TICKS; tick++) {
        for (int joint = 0; joint < SUREFOOT_JOINTS; joint++) {
            print_bits(commands[tick].torques[joint]);
        }
        print("\n");
    }
    return last == SUREFOOT_STATUS_OK && commands[TICKS - 1].mode == SUREFOOT_MODE_ACTIVE ? 0 : 1;
}
