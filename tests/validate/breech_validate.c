/* SPDX-License-Identifier: BSD-3-Clause */
/* The validations as curves.
 *
 *   breech-validate [--quick] [--basis gimp|bspline] [--transfer tpic|pic] [--courant C] [-o DIR] [NAME ...]
 *
 * Each line: resolution, the case's figures, books, point-steps and processor time (one thread).  With -o DIR the
 * same goes to DIR/<name>.dat and a gnuplot picture of all, DIR/validation.svg: error against cell size and against
 * time. */
#include "valid.h"

typedef struct {
    bool quick;
    valid_scheme scheme;
    const char *dir;
    int names;
    char **name;
} options;

static bool wanted(const options *o, const valid_case *c)
{
    for (int i = 0; i < o->names; i++)
        if (strncmp(o->name[i], c->name, strlen(o->name[i])) == 0) return true;
    return o->names == 0;
}

static void print_figures(FILE *f, const valid_case *c, double cells, const valid_result *r, double seconds)
{
    fprintf(f, "%8g", cells);
    for (int i = 0; i < VALID_FIGURES && c->figure[i]; i++) fprintf(f, "  %11.4e", r->figure[i]);
    fprintf(f, "  %9.1e  %9.1e  %9.1e  %10.3e  %8.2f\n", r->energy, r->momentum, r->mass, r->particle_steps, seconds);
    fflush(f);
}

static void print_head(FILE *f, const valid_case *c)
{
    fprintf(f, "# %s  %s.  Cells of the %s", c->name, c->doc, c->per);
    for (int i = 0; i < VALID_FIGURES && c->figure[i]; i++) fprintf(f, "; %s", c->figure[i]);
    fprintf(f, "; energy, momentum, mass of the books; point-steps; s\n");
}

static FILE *open_data(const options *o, const valid_case *c)
{
    char path[600];
    if (!o->dir) return NULL;
    snprintf(path, sizeof path, "%s/%s.dat", o->dir, c->name);
    FILE *f = fopen(path, "w");
    if (!f) {
        fprintf(stderr, "breech-validate: cannot write %s\n", path);
        exit(1);
    }
    print_head(f, c);
    return f;
}

static void run_case(const options *o, const valid_case *c)
{
    FILE *f = open_data(o, c);
    double first = 0, first_cells = 0, error = 0, cells = 0;
    print_head(stdout, c);
    for (int i = 0; i < VALID_LEVELS && c->cells[i] > 0 && !(o->quick && i >= c->quick); i++) {
        valid_result r = { .particle_steps = 0 };
        const double from = valid_clock();
        cells = c->cells[i];
        c->run(cells, &o->scheme, &r);
        const double seconds = valid_clock() - from;
        error = r.figure[0];
        if (i == 0) first = error, first_cells = cells;
        print_figures(stdout, c, cells, &r, seconds);
        if (f) print_figures(f, c, cells, &r, seconds);
    }
    if (cells > first_cells) printf("order %.2f\n", log(first / error) / log(cells / first_cells));
    putchar('\n');
    if (f) fclose(f);
}

/* ---- the picture ---- */

static void draw(const options *o)
{
    FILE *p = popen("gnuplot", "w");
    if (!p) return;
    fprintf(p, "set terminal svg size 1000,460 font ',11' background rgb 'white'\nset output '%s/validation.svg'\n",
            o->dir);
    fprintf(p, "set multiplot layout 1,2\nset logscale xy\nset format y '10^{%%L}'\nset key outside below maxrows 5\n");
    for (int side = 0; side < 2; side++) {
        fprintf(p, "set xlabel '%s'\nset ylabel 'error'\nplot ", side ? "processor time, s" : "cells");
        for (int i = 0; i < valid_cases; i++) {
            const valid_case *c = &valid_table[i];
            int columns = 1;
            while (columns <= VALID_FIGURES && c->figure[columns - 1]) columns++;
            if (wanted(o, c))
                fprintf(p, "'%s/%s.dat' using %d:2 with linespoints title '%s', ", o->dir, c->name,
                        side ? columns + 5 : 1, c->name);
        }
        fprintf(p, "\n");
    }
    pclose(p);
}

static void usage(void)
{
    fprintf(stderr,
            "usage: breech-validate [--quick] [--basis gimp|bspline] [--transfer tpic|pic] [--courant C] [-o DIR] "
            "[NAME ...]\nnames:");
    for (int i = 0; i < valid_cases; i++) fprintf(stderr, " %s", valid_table[i].name);
    fprintf(stderr, "\n");
    exit(2);
}

static options read_options(int argc, char **argv)
{
    options o = { .scheme = valid_default };
    int i = 1;
    for (; i < argc && argv[i][0] == '-'; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(argv[i], "--quick") == 0) {
            o.quick = true;
            continue;
        }
        i++;
        if (strcmp(argv[i - 1], "--basis") == 0)
            o.scheme.basis = strcmp(value, "bspline") == 0 ? MPM_BASIS_BSPLINE : MPM_BASIS_GIMP;
        else if (strcmp(argv[i - 1], "--transfer") == 0)
            o.scheme.transfer = strcmp(value, "pic") == 0 ? MPM_TRANSFER_PIC : MPM_TRANSFER_TPIC;
        else if (strcmp(argv[i - 1], "--courant") == 0)
            o.scheme.courant = atof(value);
        else if (strcmp(argv[i - 1], "-o") == 0 && *value)
            o.dir = value;
        else
            usage();
    }
    o.names = argc - i, o.name = argv + i;
    for (; i < argc; i++)
        if (argv[i][0] == '-') usage(); /* an option after a name would do nothing */
    return o;
}

int main(int argc, char **argv)
{
    const options o = read_options(argc, argv);
    for (int i = 0; i < valid_cases; i++)
        if (wanted(&o, &valid_table[i])) run_case(&o, &valid_table[i]);
    if (o.dir) draw(&o);
    return 0;
}
