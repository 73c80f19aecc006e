/* SPDX-License-Identifier: BSD-3-Clause */
/* Which instruction set the kernels run in: the best one this machine has, unless one is asked for by name. */
#include "mpm/memory/store.h"

#include <stdio.h>
#include <string.h>

#define KERNELS_OF(isa)                                 \
    void mpm_p2g_##isa(mpm *m, brick *b);               \
    void mpm_gather_##isa(mpm *m, int site);            \
    void mpm_nodes_##isa(mpm *m, int site, int thread); \
    void mpm_touch_##isa(mpm *m, int site, int thread); \
    size_t mpm_node_bytes_##isa(int groups);            \
    void mpm_g2p_##isa(mpm *m, brick *b, int thread);   \
    void mpm_relax_##isa(mpm *m, brick *b, relax_pass pass, int nth, double time);

#ifdef BREECH_ISA_V4
KERNELS_OF(v4)
#endif
#ifdef BREECH_ISA_V3
KERNELS_OF(v3)
#endif
KERNELS_OF(portable)

static const kernels table[] = {
#ifdef BREECH_ISA_V4
    { "x86-64-v4", mpm_p2g_v4, mpm_gather_v4, mpm_nodes_v4, mpm_touch_v4, mpm_node_bytes_v4, mpm_g2p_v4, mpm_relax_v4 },
#endif
#ifdef BREECH_ISA_V3
    { "x86-64-v3", mpm_p2g_v3, mpm_gather_v3, mpm_nodes_v3, mpm_touch_v3, mpm_node_bytes_v3, mpm_g2p_v3, mpm_relax_v3 },
#endif
    { "portable", mpm_p2g_portable, mpm_gather_portable, mpm_nodes_portable, mpm_touch_portable,
      mpm_node_bytes_portable, mpm_g2p_portable, mpm_relax_portable },
};

static bool runs_here(const char *name)
{
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (strcmp(name, "x86-64-v4") == 0)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl");
    if (strcmp(name, "x86-64-v3") == 0)
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
#endif
    return strcmp(name, "portable") == 0;
}

/* What scenes that name none run in; NULL: the first of the table that runs here. */
static const kernels *usual;

const kernels *mpm_kernels_choose(const char *name)
{
    if (usual && (!name || !name[0])) return usual;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if ((!name || !name[0] || strcmp(name, table[i].name) == 0) && runs_here(table[i].name)) return &table[i];
    return NULL;
}

status mpm_instruction_set_choose(const char *name)
{
    usual = NULL;
    const kernels *chosen = mpm_kernels_choose(name);
    if (chosen) {
        if (name && name[0]) usual = chosen;
        return status_ok();
    }
    char here[80] = "";
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (runs_here(table[i].name)) snprintf(here + strlen(here), sizeof here - strlen(here), " %s", table[i].name);
    return base_status_error(STATUS_BAD_INPUT,
                             "instruction set `%.40s` is unknown, or this machine lacks it; here run:%s", name, here);
}

const char *mpm_instruction_set(void)
{
    return mpm_kernels_choose(NULL)->name;
}
