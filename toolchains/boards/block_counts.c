/* A plugin of QEMU's user mode that counts how often each translated block of a program runs. The argument
 * out=FILE names the output file. It has a line "OFFSET BYTES INSTRUCTIONS COUNT" for each block of the
 * program itself that ran; OFFSET (hexadecimal) counts from the start of the program's code. The last line is
 * "other INSTRUCTIONS", the number of instructions that ran in libraries.
 *
 * Debian has no header for plugins; so the necessary part of QEMU's API is declared here. This part is the
 * same in versions 1 (QEMU 7) to 4 (QEMU 10). API_VERSION is a version that the installed QEMU accepts. */
#include <inttypes.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
typedef struct qemu_info_t qemu_info_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };
typedef void (*qemu_plugin_vcpu_tb_trans_cb_t)(qemu_plugin_id_t, struct qemu_plugin_tb *);
typedef void (*qemu_plugin_vcpu_udata_cb_t)(unsigned int, void *);
typedef void (*qemu_plugin_udata_cb_t)(qemu_plugin_id_t, void *);
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, qemu_plugin_vcpu_tb_trans_cb_t);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, qemu_plugin_udata_cb_t, void *);
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb *, qemu_plugin_vcpu_udata_cb_t,
                                          enum qemu_plugin_cb_flags, void *);
uint64_t qemu_plugin_tb_vaddr(const struct qemu_plugin_tb *);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *, size_t);
size_t qemu_plugin_insn_size(const struct qemu_plugin_insn *);
uint64_t qemu_plugin_start_code(void);
uint64_t qemu_plugin_end_code(void);

#define EXPORT __attribute__((visibility("default")))
EXPORT int qemu_plugin_version = API_VERSION;

struct block {
    uint64_t address, bytes, instructions, count;
    struct block *next;
};

static struct block *blocks;
static const char *out;

static void ran(unsigned int cpu, void *block)
{
    (void)cpu;
    ++((struct block *)block)->count;
}

/* Called when a block is translated. Needs no lock, because QEMU holds one during translation. */
static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb *tb)
{
    struct block *b = calloc(1, sizeof *b);
    (void)id;
    if (b == NULL)
        abort();
    b->address = qemu_plugin_tb_vaddr(tb);
    b->instructions = qemu_plugin_tb_n_insns(tb);
    for (size_t i = 0; i < b->instructions; ++i)
        b->bytes += qemu_plugin_insn_size(qemu_plugin_tb_get_insn(tb, i));
    b->next = blocks;
    blocks = b;
    qemu_plugin_register_vcpu_tb_exec_cb(tb, ran, QEMU_PLUGIN_CB_NO_REGS, b);
}

static void print(qemu_plugin_id_t id, void *unused)
{
    const uint64_t start = qemu_plugin_start_code(), end = qemu_plugin_end_code();
    uint64_t other = 0;
    FILE *file = fopen(out, "w");
    (void)id;
    (void)unused;
    if (file == NULL)
        abort();
    for (const struct block *b = blocks; b != NULL; b = b->next) {
        if (b->address < start || b->address >= end)
            other += b->instructions * b->count;
        else if (b->count > 0)
            fprintf(file, "%" PRIx64 " %" PRIu64 " %" PRIu64 " %" PRIu64 "\n", b->address - start,
                    b->bytes, b->instructions, b->count);
    }
    fprintf(file, "other %" PRIu64 "\n", other);
    fclose(file);
}

EXPORT int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t *info, int argc, char **argv)
{
    (void)info;
    for (int i = 0; i < argc; ++i)
        if (strncmp(argv[i], "out=", 4) == 0)
            out = argv[i] + 4;
    if (out == NULL) {
        fprintf(stderr, "block_counts: the argument out=FILE is missing\n");
        return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, print, NULL);
    return 0;
}
