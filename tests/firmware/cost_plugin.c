// SPDX-License-Identifier: MIT
// What functions of a firmware cost: a plugin of QEMU that counts instructions.
//
//   qemu-system-arm -plugin cost.so,log=FILE,tick=BEGIN:END,NAME=BEGIN:END... -kernel IMAGE
//
// BEGIN and END are the addresses of a function. FILE gets a line "NAME calls mean first later" for each when QEMU
// ends: the instructions from the first one of the function to its return, with all that it calls, on average, in the
// longest of the first 128 calls and of those after them. Instructions of the interrupt, `tick`, are counted apart. A
// last line, "late N", says by how many instructions the longest time from one interrupt to the next was above the
// mean. A function returns by loading pc from the stack, or by bx lr. Debian's QEMU exports the functions of its
// plugins' interface; its header is in no package.
#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void (*OnCode)(uint64_t id, void* block);
typedef void (*OnInstruction)(unsigned cpu, void* data);
void qemu_plugin_register_vcpu_tb_trans_cb(uint64_t id, OnCode callback);
void qemu_plugin_register_vcpu_insn_exec_cb(void* instruction, OnInstruction callback, int registers, void* data);
void qemu_plugin_register_vcpu_insn_exec_inline(void* instruction, int operation, void* number, uint64_t operand);
void qemu_plugin_register_atexit_cb(uint64_t id, void (*callback)(uint64_t, void*), void* data);
size_t qemu_plugin_tb_n_insns(const void* block);
void* qemu_plugin_tb_get_insn(const void* block, size_t i);
uint64_t qemu_plugin_insn_vaddr(const void* instruction);
char* qemu_plugin_insn_disas(const void* instruction);
__attribute__((visibility("default"))) int qemu_plugin_version = 1;

struct function {
    char name[32];
    uint64_t begin, end, began_at, calls, sum, longest[2];
    bool open;
};
static struct function functions[8]; // the first one is the interrupt
static int count;
static const int add_u64 = 0;
static uint64_t executed, of_ticks; // instructions before this one; those of interrupts that have ended
static uint64_t first_tick, last_tick, longest_gap;
static FILE* out;

// The instructions of the interrupt, or those of all the rest, before this one.
static uint64_t instructions_of(const struct function* f) {
    return f == functions ? executed : executed - of_ticks;
}
static void entering(unsigned cpu, void* data) {
    struct function* f = data;
    (void)cpu;
    f->open = true;
    f->began_at = instructions_of(f);
    if (f == functions) {
        const uint64_t gap = f->calls ? executed - last_tick : 0;
        longest_gap = gap > longest_gap ? gap : longest_gap;
        first_tick = f->calls ? first_tick : executed;
        last_tick = executed;
    }
}
static void leaving(unsigned cpu, void* data) {
    struct function* f = data;
    (void)cpu;
    if (!f->open) {
        return;
    }
    const uint64_t took = instructions_of(f) - f->began_at + 1;
    f->open = false;
    f->sum += took;
    of_ticks += f == functions ? took : 0;
    uint64_t* longest = &f->longest[f->calls++ >= 128];
    *longest = took > *longest ? took : *longest;
}

static void translated(uint64_t id, void* block) {
    (void)id;
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i) {
        void* instruction = qemu_plugin_tb_get_insn(block, i);
        const uint64_t at = qemu_plugin_insn_vaddr(instruction);
        for (int k = 0; k < count; ++k) {
            if (at == functions[k].begin) {
                qemu_plugin_register_vcpu_insn_exec_cb(instruction, entering, 0, &functions[k]);
            }
            if (at >= functions[k].begin && at < functions[k].end) {
                char* text = qemu_plugin_insn_disas(instruction);
                if (strstr(text, "pc}") || strstr(text, "pc, [sp]") || (strstr(text, "bx") && strstr(text, "lr"))) {
                    qemu_plugin_register_vcpu_insn_exec_cb(instruction, leaving, 0, &functions[k]);
                }
                free(text);
            }
        }
        qemu_plugin_register_vcpu_insn_exec_inline(instruction, add_u64, &executed,
                                                   1); // behind the callbacks: QEMU sees to that
    }
}

static void ending(uint64_t id, void* data) {
    (void)id, (void)data;
    for (int k = 0; k < count; ++k) {
        const struct function* f = &functions[k];
        fprintf(out, "%s %" PRIu64 " %" PRIu64 " %" PRIu64 " %" PRIu64 "\n", f->name, f->calls,
                f->calls ? f->sum / f->calls : 0, f->longest[0], f->longest[1]);
    }
    const uint64_t gaps = functions[0].calls > 1 ? functions[0].calls - 1 : 1;
    fprintf(out, "late %" PRIu64 "\n", longest_gap - (last_tick - first_tick) / gaps);
    fclose(out);
}

__attribute__((visibility("default"))) int qemu_plugin_install(uint64_t id, const void* info, int argc, char** argv) {
    (void)info;
    for (int i = 0; i < argc; ++i) {
        struct function* f = &functions[count];
        if (!strncmp(argv[i], "log=", 4)) {
            out = fopen(argv[i] + 4, "w");
        } else if (count < 8 && sscanf(argv[i], "%31[^=]=%" SCNx64 ":%" SCNx64, f->name, &f->begin, &f->end) == 3) {
            ++count;
        } else {
            return 1;
        }
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, ending, NULL);
    return out && count ? 0 : 1;
}
