// SPDX-License-Identifier: MIT
// The pins of a board, with time: a plugin of QEMU 7.2 that puts I/O ports into the emulated machine, over what QEMU
// has there or does not have.
//
//   qemu-system-arm -plugin pins.so,log=FILE,contacts=FILE,FAMILY=ADDRESS... -kernel IMAGE
//
// FAMILY is stm32, nrf51 or pl061. On each pin is a contact to ground; in `contacts` the test has a number of 32 bits
// for each of four ports, in the host's order of bytes, in which the bits of closed contacts are set. A fifth number
// says after how many lines of the log the machine halts, as by QEMU's command `stop`; 0: never. A sixth says at which
// tick, likewise; in the seventh the plugin says which tick it is. A pin that is no output is low where its contact is
// closed or where it has no pull-up; an output is low until the firmware drives it.
// `log` gets a line "NS TICK PORT PIN LEVEL" for each change: of an output when it changes, of an input when the
// firmware first reads the new level. NS is the machine's time; TICK says how many times the inputs of the first port
// were read, which the firmware does once in each tick; PORT counts from 0. Debian's QEMU exports its own functions;
// what is declared here is in no package.
#include <fcntl.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

struct sizes {
    unsigned least, most;
    bool unaligned;
};
struct region_operations { // MemoryRegionOps
    uint64_t (*read)(void* port, uint64_t at, unsigned size);
    void (*write)(void* port, uint64_t at, uint64_t value, unsigned size);
    void *read_with_attributes, *write_with_attributes;
    int endianness, padding;
    struct sizes valid;
    void* accepts;
    struct sizes implemented;
};
void memory_region_init_io(void* region, void* owner, const struct region_operations* operations, void* opaque,
                           const char* name, uint64_t size);
void memory_region_add_subregion_overlap(void* space, uint64_t at, void* region, int priority);
void* get_system_memory(void);
void* object_resolve_path(const char* path, bool* ambiguous);
int vm_stop(int state);
void qemu_register_reset(void (*reset)(void*), void* opaque);
int64_t qemu_clock_get_ns(int clock);
void qemu_plugin_register_vcpu_init_cb(uint64_t id, void (*callback)(uint64_t id, unsigned cpu));
__attribute__((visibility("default"))) int qemu_plugin_version = 1;

struct port;
struct family {
    const char* name;
    uint64_t size;
    uint32_t (*inputs_read)(uint64_t at); // the pins that a read at this register gives
    void (*write)(struct port* p, uint64_t at, uint32_t value);
};
struct port {
    const struct family* family;
    uint64_t base;
    uint32_t registers[1024];
    uint32_t out, outputs, pull_up; // a bit for each pin: its output latch, whether it is an output, has a pull-up
    uint32_t driven, seen;          // what the log knows: levels of outputs, and of inputs
};
static struct port ports[4];
static int count;
static volatile uint32_t* contacts;
static uint64_t ticks;
static FILE* out;
static uint32_t lines;
enum { halt_after = 4, halt_at = 5, tick = 6, places = 7 }; // in contacts
enum { paused = 4 };                                        // RUN_STATE_PAUSED

static void tell(const struct port* p, uint32_t changed, uint32_t levels) {
    for (int pin = 0; pin < 32 && changed >> pin != 0; ++pin) {
        if ((changed >> pin & 1) != 0) {
            fprintf(out, "%" PRId64 " %" PRIu64 " %d %d %d\n", qemu_clock_get_ns(1), ticks, (int)(p - ports), pin,
                    (int)(levels >> pin & 1));
            ++lines;
        }
    }
    if (contacts[halt_after] != 0 && lines >= contacts[halt_after]) {
        vm_stop(paused);
    }
}

// STM32F4: RM0090, "GPIO registers". Two bits for each pin in MODER and PUPDR.
static uint32_t pins_with_01(uint32_t pairs) {
    uint32_t pins = 0;
    for (int pin = 0; pin < 16; ++pin) {
        pins |= (uint32_t)((pairs >> 2 * pin & 3) == 1) << pin;
    }
    return pins;
}
static uint32_t stm32_inputs_read(uint64_t at) {
    return at == 0x10 ? 0xffff : 0; // IDR
}
static void stm32_write(struct port* p, uint64_t at, uint32_t value) {
    p->out = at == 0x14 ? value : at == 0x18 ? (p->out & ~(value >> 16)) | (value & 0xffff) : p->out; // ODR, BSRR
    p->registers[0x14 / 4] = p->out;
    p->outputs = pins_with_01(p->registers[0]);        // MODER
    p->pull_up = pins_with_01(p->registers[0x0c / 4]); // PUPDR
}

// nRF51: Reference Manual 3.0, chapter GPIO.
static uint32_t nrf51_inputs_read(uint64_t at) {
    return at == 0x510 ? ~0U : 0; // IN
}
static void nrf51_write(struct port* p, uint64_t at, uint32_t value) {
    p->out = at == 0x504 ? value : (p->out | (at == 0x508 ? value : 0)) & ~(at == 0x50c ? value : 0); // OUT, -SET, -CLR
    p->outputs |= at == 0x518 ? value : 0;                                                            // DIRSET
    p->registers[0x504 / 4] = p->out;
    if (at >= 0x700 && at < 0x780) { // PIN_CNF: bit 0 output, bit 1 input off, bits 2 and 3: 3 is a pull-up
        const uint32_t pin = 1U << (at - 0x700) / 4;
        p->outputs = (value & 1) != 0 ? p->outputs | pin : p->outputs & ~pin;
        p->pull_up = (value & 0xe) == 0xc ? p->pull_up | pin : p->pull_up & ~pin;
    }
}

// LM3S6965: SPMS019, chapter "General-Purpose Input/Outputs": bits 2 to 9 of GPIODATA's address are a mask.
static uint32_t pl061_inputs_read(uint64_t at) {
    return at < 0x400 ? (uint32_t)(at >> 2) : 0;
}
static void pl061_write(struct port* p, uint64_t at, uint32_t value) {
    const uint32_t mask = pl061_inputs_read(at);
    p->out = (p->out & ~mask) | (value & mask);
    const uint32_t digital = p->registers[0x51c / 4] & ~p->registers[0x420 / 4]; // GPIODEN, GPIOAFSEL
    p->outputs = p->registers[0x400 / 4] & digital;                              // GPIODIR
    p->pull_up = p->registers[0x510 / 4] & digital;                              // GPIOPUR
}

static const struct family families[] = {{"stm32", 0x400, stm32_inputs_read, stm32_write},
                                         {"nrf51", 0x1000, nrf51_inputs_read, nrf51_write},
                                         {"pl061", 0x1000, pl061_inputs_read, pl061_write}};

static void tell_outputs(struct port* p) {
    const uint32_t levels = p->out & p->outputs;
    tell(p, levels ^ p->driven, levels);
    p->driven = levels;
}
static uint64_t port_read(void* opaque, uint64_t at, unsigned size) {
    struct port* p = opaque;
    (void)size;
    const uint32_t pins = p->family->inputs_read(at);
    if (pins == 0) {
        return p->registers[at / 4];
    }
    if (p == ports) {
        contacts[tick] = (uint32_t)++ticks;
        if (contacts[halt_at] != 0 && contacts[halt_at] <= ticks) {
            contacts[halt_at] = 0;
            vm_stop(paused);
        }
    }
    const uint32_t levels = p->pull_up & ~contacts[p - ports] & ~p->outputs;
    const uint32_t changed = (levels ^ p->seen) & pins;
    tell(p, changed, levels);
    p->seen ^= changed;
    return (levels | (p->out & p->outputs)) & pins;
}
static void port_write(void* opaque, uint64_t at, uint64_t value, unsigned size) {
    struct port* p = opaque;
    (void)size;
    p->registers[at / 4] = (uint32_t)value;
    p->family->write(p, at, (uint32_t)value);
    tell_outputs(p);
}
static void reset(void* opaque) {
    struct port* p = opaque;
    memset(p->registers, 0, sizeof p->registers);
    p->out = p->outputs = p->pull_up = 0;
    tell_outputs(p);
}
static const struct region_operations operations = {
    .read = port_read, .write = port_write, .valid = {.least = 4, .most = 4}, .implemented = {.least = 4, .most = 4}};

static void put_in(uint64_t id, unsigned cpu) {
    (void)id, (void)cpu;
    void* space = object_resolve_path("nrf51-container[0]", NULL); // lies over the system's memory
    for (struct port* p = ports; p < ports + count; ++p) {
        void* region = calloc(1, 4096); // longer than a MemoryRegion
        memory_region_init_io(region, NULL, &operations, p, "pins", p->family->size);
        memory_region_add_subregion_overlap(space ? space : get_system_memory(), p->base, region, 1000);
        qemu_register_reset(reset, p);
    }
}

__attribute__((visibility("default"))) int qemu_plugin_install(uint64_t id, const void* info, int argc, char** argv) {
    (void)info;
    for (int i = 0; i < argc; ++i) {
        struct port* p = &ports[count];
        char family[8];
        if (!strncmp(argv[i], "log=", 4)) {
            out = fopen(argv[i] + 4, "w");
        } else if (!strncmp(argv[i], "contacts=", 9)) {
            const int file = open(argv[i] + 9, O_RDWR);
            contacts = mmap(NULL, sizeof(uint32_t) * places, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        } else if (count < 4 && sscanf(argv[i], "%7[^=]=%" SCNx64, family, &p->base) == 2) {
            for (size_t k = 0; k < 3; ++k) {
                p->family = !strcmp(family, families[k].name) ? &families[k] : p->family;
            }
            if (!p->family) {
                return 1;
            }
            ++count;
        } else {
            return 1;
        }
    }
    if (!out || !contacts || contacts == MAP_FAILED || setvbuf(out, NULL, _IOLBF, 4096)) { // it is read meanwhile
        return 1;
    }
    qemu_plugin_register_vcpu_init_cb(id, put_in);
    return 0;
}
