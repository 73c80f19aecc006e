/* SPDX-License-Identifier: BSD-3-Clause */
/* What bash and zsh complete: commands, the options that each takes, folders, materials, what a case begins from. */
#include "coupling/usage/usage.h"
#include "coupling/case/case_new.h"

#include <string.h>

static const char *const materials = "breech materials 2>/dev/null | awk 'NR > 1 { if (!NF) exit; print $1 }'";

static void print_commands(const char *between, FILE *out)
{
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++) fprintf(out, "%s%s", i ? between : "", usage_command_at(i).name);
}

static void print_starts(FILE *out)
{
    for (const case_kind *k = case_kinds; k->name; k++) fprintf(out, "%s%s", k == case_kinds ? "" : " ", k->name);
}

/* ---- bash ---- */

/* Names of the options, of both lists, that have this kind of value; "--set|--threads". */
static int print_options_of(usage_names names, FILE *out)
{
    const usage_option *const lists[] = { usage_options, usage_words };
    int n = 0;
    for (int k = 0; k < 2; k++)
        for (const usage_option *o = lists[k]; o->name; o++)
            if (o->value && o->completes == names) fprintf(out, "%s%s", n++ ? "|" : "", o->name);
    return n;
}

static void bash_values(FILE *out)
{
    fputs("    case $prev in\n    ", out);
    print_options_of(USAGE_FOLDERS, out);
    fputs(")\n        COMPREPLY=($(compgen -d -- \"$cur\"))\n        return ;;\n    ", out);
    print_options_of(USAGE_STARTS, out);
    fputs(")\n        COMPREPLY=($(compgen -W '", out);
    print_starts(out);
    fputs("' -- \"$cur\") $(compgen -f -- \"$cur\"))\n        return ;;\n    ", out);
    print_options_of(USAGE_COMMANDS, out);
    fputs(")\n        COMPREPLY=($(compgen -W '", out);
    print_commands(" ", out);
    fputs("' -- \"$cur\"))\n        return ;;\n    ", out);
    print_options_of(USAGE_SHELLS, out);
    fputs(")\n        COMPREPLY=($(compgen -W 'bash zsh' -- \"$cur\"))\n        return ;;\n    ", out);
    print_options_of(USAGE_NO_NAMES, out);
    fputs(")\n        return ;;\n    esac\n", out);
}

static void bash_options(FILE *out)
{
    fputs("        case $command in\n", out);
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++) {
        const usage_command c = usage_command_at(i);
        fprintf(out, "        %s) words='--help", c.name);
        for (const usage_option *o = usage_options; o->name; o++)
            if (usage_takes(&c, o)) fprintf(out, " %s", o->name);
        fputs("' ;;\n", out);
    }
    fputs("        *) words='", out);
    for (const usage_option *o = usage_words; o->name; o++) fprintf(out, "%s%s", o == usage_words ? "" : " ", o->name);
    fputs("' ;;\n        esac\n", out);
}

static void bash(FILE *out)
{
    fputs("# Completion of breech for bash, made by `breech --completion bash`.\n"
          "_breech()\n{\n"
          "    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} command='' words word\n"
          "    COMPREPLY=()\n"
          "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n        case $word in\n        ",
          out);
    print_commands("|", out);
    fputs(")\n            command=$word\n            break ;;\n        esac\n    done\n", out);
    bash_values(out);
    fputs("    if [[ $cur == -* ]]; then\n", out);
    bash_options(out);
    fputs("        COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n        return\n    fi\n    case $command in\n"
          "    '') COMPREPLY=($(compgen -W '",
          out);
    print_commands(" ", out);
    fprintf(out,
            "' -- \"$cur\")) ;;\n    materials|flow) COMPREPLY=($(compgen -W \"$(%s)\" -- \"$cur\")) ;;\n    new) ;;\n"
            "    *) COMPREPLY=($(compgen -f -- \"$cur\")) ;;\n    esac\n}\ncomplete -o filenames -F _breech breech\n",
            materials);
}

/* ---- zsh ---- */

/* Text inside '...[here]...' of _arguments, or after name: of _describe. */
static void zsh_text(const char *text, FILE *out)
{
    for (; *text; text++) {
        if (strchr("[]:\\", *text)) fputc('\\', out);
        if (*text == '\'')
            fputs("'\\''", out);
        else
            fputc(*text, out);
    }
}

static void zsh_value(usage_names names, FILE *out)
{
    switch (names) {
    case USAGE_FOLDERS: fputs("_files -/", out); break;
    case USAGE_STARTS:
        fputs("{ compadd ", out);
        print_starts(out);
        fputs("; _files }", out);
        break;
    case USAGE_COMMANDS:
        fputs("(", out);
        print_commands(" ", out);
        fputs(")", out);
        break;
    case USAGE_SHELLS: fputs("(bash zsh)", out); break;
    case USAGE_NO_NAMES: fputs(" ", out); break;
    }
}

static void zsh_option(const usage_option *o, FILE *out)
{
    fprintf(out, " \\\n            '%s%s[", o->kind == USAGE_SET ? "*" : "", o->name);
    zsh_text(o->doc, out);
    fputc(']', out);
    if (o->value) {
        fputc(':', out);
        zsh_text(o->value, out);
        fputc(':', out);
        zsh_value(o->completes, out);
    }
    fputc('\'', out);
}

static void zsh_subject(const usage_command *c, FILE *out)
{
    if (c->number == STUDIES + USAGE_new)
        fputs(" \\\n            '2:NAME: '", out);
    else if (c->number == STUDIES + USAGE_materials || c->number == STUDIES + USAGE_flow)
        fputs(" \\\n            '2:NAME:{ compadd $(_breech_materials) }'", out);
    else
        fprintf(out, " \\\n            '2:%s:_files'", c->subject);
}

static void zsh(FILE *out)
{
    fprintf(out,
            "#compdef breech\n# Completion of breech for zsh, made by `breech --completion zsh`.\n"
            "_breech_materials()\n{\n    %s\n}\n_breech()\n{\n    local -a commands=(",
            materials);
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++) {
        fprintf(out, "\n        '%s:", usage_command_at(i).name);
        zsh_text(usage_command_at(i).doc, out);
        fputc('\'', out);
    }
    fputs("\n    )\n    case $words[2] in\n", out);
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++) {
        const usage_command c = usage_command_at(i);
        fprintf(out, "    %s)\n        _arguments '1:command: '", c.name);
        zsh_subject(&c, out);
        for (const usage_option *o = usage_options; o->name; o++)
            if (usage_takes(&c, o)) zsh_option(o, out);
        fputs(" ;;\n", out);
    }
    fputs("    *)\n        _arguments '1:command:{ _describe command commands }'", out);
    for (const usage_option *o = usage_words; o->name; o++) zsh_option(o, out);
    fputs(" ;;\n    esac\n}\nif [ \"$funcstack[1]\" = _breech ]; then\n    _breech \"$@\"\nelse\n"
          "    compdef _breech breech\nfi\n",
          out);
}

status usage_completion(const char *shell, FILE *out)
{
    const bool is_bash = strcmp(shell, "bash") == 0;
    CHECK(is_bash || strcmp(shell, "zsh") == 0, STATUS_BAD_INPUT, "--completion %.40s: must be bash or zsh", shell);
    if (is_bash)
        bash(out);
    else
        zsh(out);
    return status_ok();
}
