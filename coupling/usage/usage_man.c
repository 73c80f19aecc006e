/* SPDX-License-Identifier: BSD-3-Clause */
/* The manual page, in the macros of man(7). */
#include "coupling/usage/usage.h"
#include "coupling/host/version.h"

#include <ctype.h>
#include <string.h>

/* Text as roff takes it; a line may not begin with a dot or an apostrophe. */
static void print_text(const char *text, FILE *out)
{
    if (*text == '.' || *text == '\'') fputs("\\&", out);
    for (; *text; text++) {
        if (*text == '\\')
            fputs("\\e", out);
        else if (*text == '-')
            fputs("\\-", out);
        else if (*text == '\'')
            fputs("\\(aq", out);
        else if (*text == '`')
            fputs("\\(ga", out);
        else if (*text == '^')
            fputs("\\(ha", out);
        else if (*text == '~')
            fputs("\\(ti", out);
        else
            fputc(*text, out);
        if (*text == '.' && text[1] == ' ') { /* a sentence ends its line */
            fputc('\n', out);
            while (text[1] == ' ') text++;
        }
    }
}

/* A line of its own; the first word of a sentence is a capital, a full stop ends it. */
static void print_sentence(const char *text, FILE *out)
{
    const size_t length = strlen(text);
    if (length == 0) return;
    fputc(toupper((unsigned char)text[0]), out);
    print_text(text + 1, out);
    fputs(strchr(".?!", text[length - 1]) ? "\n" : ".\n", out);
}

static void print_option(const usage_option *o, FILE *out)
{
    fputs(".TP\n\\fB", out);
    print_text(o->name, out);
    fputs("\\fR", out);
    if (o->value) fprintf(out, " \\fI%s\\fR", o->value);
    fputc('\n', out);
    print_sentence(o->doc, out);
}

static void print_command(const usage_command *c, FILE *out)
{
    fputs(".SS \"breech ", out);
    fprintf(out, "%s %s\"\n", c->name, c->subject);
    print_sentence(c->doc, out);
    print_sentence(c->more, out);
    const char *before = "Options: ";
    for (const usage_option *o = usage_options; o->name; o++) {
        if (!usage_takes(c, o)) continue;
        fputs(before, out);
        fputs("\\fB", out);
        print_text(o->name, out);
        fputs("\\fR", out);
        before = ",\n";
    }
    fputs(strcmp(before, ",\n") == 0 ? ".\n" : "", out);
    if (!c->example) return;
    fputs(".PP\n.RS\n.nf\n", out);
    print_text(c->example, out);
    fputs("\n.fi\n.RE\n", out);
}

void usage_man(FILE *out)
{
    fprintf(out, ".TH BREECH 1 \"\" \"breech %s\" \"User Commands\"\n", host_version());
    fputs(".SH NAME\nbreech \\- railgun shots, from the charged bank to the gouged rail\n"
          ".SH SYNOPSIS\n.B breech\n.I command case\n.RI [ options ]\n",
          out);
    for (const usage_option *o = usage_words; o->name; o++) {
        fputs(".br\n.B breech ", out);
        print_text(o->name, out);
        if (o->value) fprintf(out, "\n.I %s", o->value);
        fputc('\n', out);
    }
    fputs(".SH DESCRIPTION\n"
          "A circuit with a model of the rails drives the armature; where it passes a grain on the rail, a solver\n"
          "computes the impact in three dimensions; the program says where along the barrel gouging begins and\n"
          "which rail surface moves that point.\nThe same solver takes any impact of bodies.\n.PP\n"
          "A\n.I case\nis a file case.yaml, or a folder that holds one.\n"
          "\\fBbreech new mine\\fR writes one to begin with; \\fBbreech \\-\\-keys\\fR lists every key.\n"
          ".SH COMMANDS\n",
          out);
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++) {
        const usage_command c = usage_command_at(i);
        print_command(&c, out);
    }
    fputs(".SH OPTIONS\n", out);
    for (const usage_option *o = usage_options; o->name; o++) print_option(o, out);
    fputs(".SH \"WORDS IN PLACE OF A COMMAND\"\n", out);
    for (const usage_option *o = usage_words; o->name; o++) print_option(o, out);
    fputs(".SH \"EXIT STATUS\"\n", out);
    for (const usage_exit *e = usage_exits; e->doc; e++) fprintf(out, ".TP\n%d\n%s\n", e->code, e->doc);
    fputs(".SH ENVIRONMENT\n.TP\n.B BREECH_MATERIALS\nA folder with materials of one\\(aqs own, looked into first.\n"
          ".TP\n.B OMP_NUM_THREADS\nThreads where \\fB\\-\\-threads\\fR is not given.\n",
          out);
    fputs(".SH FILES\n.TP\n.I out/<case>/summary.json\nEvery number of a run, in SI units.\n"
          ".TP\n.I out/<case>/history.h5\nSeries over time.\n"
          ".TP\n.I out/<case>/report.html\nThe report.\n"
          ".TP\n.I out/<case>/used.yaml\nThe case with every value as it was used.\n",
          out);
}
