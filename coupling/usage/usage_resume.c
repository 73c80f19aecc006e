/* SPDX-License-Identifier: BSD-3-Clause */
/* The command line that goes on with a stopped run. */
#include "coupling/usage/usage.h"

#include <string.h>

/* As a shell reads it back. */
static void print_word(const char *word, FILE *out)
{
    const bool plain = word[0] && !word[strspn(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                                     "_-./=:,+%@")];
    if (plain) {
        fprintf(out, " %s", word);
        return;
    }
    fputs(" '", out);
    for (; *word; word++) fputs(*word == '\'' ? "'\\''" : (char[]){ *word, '\0' }, out);
    fputc('\'', out);
}

static void print_option(const usage_line *l, const usage_option *o, FILE *out)
{
    const char *member = (const char *)l + o->offset;
    fprintf(out, " %s", o->name);
    if (o->kind == USAGE_TEXT) print_word(*(const char *const *)(const void *)member, out);
    if (o->kind == USAGE_COUNT) fprintf(out, " %d", *(const int *)(const void *)member);
}

void usage_print_resume(const usage_line *l, const char *dir, FILE *out)
{
    /* said otherwise below, or of the stopped run alone */
    static const char *const not_again[] = { "-o",      "--ensemble",     "--set",   "--resume",
                                             "--force", "--max-walltime", "--quiet", NULL };
    fprintf(out, "breech %s", l->command.name);
    print_word(l->subject, out);
    for (int k = 0; k < l->n_sets; k++) { /* --ensemble is among them */
        fputs(" --set", out);
        print_word(l->sets[k], out);
    }
    for (const usage_option *o = usage_options; o->name; o++) {
        bool again = usage_given(l, o->name);
        for (int k = 0; not_again[k]; k++) again &= strcmp(o->name, not_again[k]) != 0;
        if (again) print_option(l, o, out);
    }
    fputs(" -o", out);
    print_word(dir, out);
    fputs(" --resume\n", out);
}
