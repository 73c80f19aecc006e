/* SPDX-License-Identifier: BSD-3-Clause */
/* The help: all of the program, and one command. */
#include "coupling/usage/usage.h"

#include <ctype.h>
#include <string.h>

enum { DOC_COLUMN = 20, WIDTH = 100 };

/* Words filled into lines from a column on; the first line begins there already. */
static void print_filled(const char *text, int indent, FILE *out)
{
    int at = indent;
    while (*text) {
        const int length = (int)strcspn(text, " \n");
        const bool full = at > indent && at + 1 + length > WIDTH;
        if (full) fprintf(out, "\n%*s", indent, "");
        if (!full && at > indent) fputc(' ', out);
        at = (full || at == indent ? indent : at + 1) + length;
        fprintf(out, "%.*s", length, text);
        text += length + (int)strspn(text + length, " \n");
    }
    fputc('\n', out);
}

static void print_option(const usage_option *o, FILE *out)
{
    char head[40];
    snprintf(head, sizeof head, "%s%s%s", o->name, o->value ? " " : "", o->value ? o->value : "");
    if (strlen(head) > DOC_COLUMN - 3)
        fprintf(out, "  %s\n%*s", head, DOC_COLUMN, "");
    else
        fprintf(out, "  %-*s", DOC_COLUMN - 2, head);
    print_filled(o->doc, DOC_COLUMN, out);
}

void usage_help_command(const usage_command *c, FILE *out)
{
    bool any = false;
    char doc[200];
    fprintf(out, "usage: breech %s %s [options]\n\n", c->name, c->subject);
    snprintf(doc, sizeof doc, "%c%s.", toupper((unsigned char)c->doc[0]), c->doc + 1);
    print_filled(doc, 0, out);
    if (c->more[0]) print_filled(c->more, 0, out);
    if (c->example) fprintf(out, "\nexample:\n  %s\n", c->example);
    for (const usage_option *o = usage_options; o->name; o++) {
        if (!usage_takes(c, o)) continue;
        if (!any) fputs("\noptions:\n", out);
        any = true;
        print_option(o, out);
    }
    fputs("\nbreech --keys lists every key of a case, with unit, range and meaning\n", out);
}

void usage_help(FILE *out)
{
    fputs("usage: breech COMMAND CASE [options]        CASE: a case.yaml, or a folder that holds one\n\n", out);
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++) {
        const usage_command c = usage_command_at(i);
        fprintf(out, "  breech %-10s %-7s ", c.name, c.subject);
        print_filled(c.doc, 28, out);
    }
    fputs("\noptions of the commands that run a case; breech --help COMMAND lists those of one:\n", out);
    for (const usage_option *o = usage_options; o->name; o++)
        if (o->taken_by & 1) print_option(o, out); /* the first is a study */
    fputc('\n', out);
    for (const usage_option *o = usage_words; o->name; o++) print_option(o, out);
    fputs("\nexit codes: ", out);
    for (const usage_exit *e = usage_exits; e->doc; e++)
        fprintf(out, "%s%d %s", e == usage_exits ? "" : ", ", e->code, e->doc);
    fputs("\n\nbegin with:  breech new mine; breech check mine; breech onset mine\n", out);
}
