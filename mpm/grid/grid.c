/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/grid/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char axis_letters[3] = { 'x', 'y', 'z' };
static const double ROUND = 1e-6;    /* of a cell */
static const double MAX_PAGES = 2e8; /* of a level; those that nothing happens in take four bytes at most */
static const double LEAST = 0.7;     /* the shortest cell at an end of the window, of the others: it sets their step */

/* ---- axes ---- */

/* A node of all levels: an end of the window that the fine zone reaches, else zero if that lies on the finest cells,
 * else the zone's lower end. */
static double origin_of(const mpm_axis *s)
{
    const double tiny = ROUND * s->fine, off = s->fine_lo / s->fine;
    if (s->fine_lo <= s->lo + tiny) return s->fine_lo;
    if (s->fine_hi >= s->hi - tiny) return s->fine_hi;
    return fabs(off - round(off)) < ROUND ? 0 : s->fine_lo;
}

/* The window in cells of the coarsest level, all of one size but those at its ends, which take what is left over. */
static status make_coarsest(const mpm_scene *s, int k, axis *out)
{
    const mpm_axis *spec = &s->axis[k];
    const double cell = spec->fine * (1 << (s->levels - 1));
    const double origin = origin_of(spec) + s->grid_shift[k] * spec->fine;
    double first = ceil((spec->lo - origin) / cell - ROUND), last = floor((spec->hi - origin) / cell + ROUND);
    const double below = first - (spec->lo - origin) / cell, above = (spec->hi - origin) / cell - last;
    CHECK(spec->fine > 0 && spec->hi > spec->lo && last - first >= 2, STATUS_BAD_INPUT,
          "levels along %c: cells of %g m, the largest of %d levels, do not fit into the window, %g to %g m: at least "
          "two of them, or fewer levels",
          axis_letters[k], cell, s->levels, spec->lo, spec->hi);
    if (below > ROUND && below < LEAST) first++;
    if (above > ROUND && above < LEAST) last--;
    mpm_axis window = *spec;
    window.fine = cell, window.coarse = 2 * cell, window.growth = 2;
    window.fine_lo = below > ROUND ? origin + first * cell : spec->lo;
    window.fine_hi = above > ROUND ? origin + last * cell : spec->hi;
    TRY(mpm_axis_make(&window, axis_letters[k], out));
    mpm_axis_allow_long(out);
    return status_ok();
}

static status make_axes(const mpm_scene *s, int k, grids *g)
{
    if (g->levels == 1)
        return mpm_axis_make_shifted(&s->axis[k], s->grid_shift[k], axis_letters[k], &g->level[0].axes[k]);
    TRY(make_coarsest(s, k, &g->level[g->levels - 1].axes[k]));
    for (int i = g->levels - 2; i >= 0; i--) {
        TRY(mpm_axis_bisect(&g->level[i + 1].axes[k], &g->level[i].axes[k]));
        if (i > 0) mpm_axis_allow_long(&g->level[i].axes[k]);
    }
    return status_ok();
}

bool mpm_grids_hold_shift(const mpm_scene *s, int k)
{
    grids g = { .levels = s->levels };
    const bool holds = make_axes(s, k, &g).code == STATUS_OK;
    for (int i = 0; i < g.levels; i++) mpm_axis_free(&g.level[i].axes[k]);
    return holds;
}

/* ---- granules ---- */

static status make_tables(grids *g)
{
    for (int i = 0; i < g->levels; i++) {
        grid_level *level = &g->level[i];
        double all = 1;
        for (int k = 0; k < 3; k++) {
            level->granules[k] = (grid_elements(level, k) + GRANULE - 1) / GRANULE;
            level->pages[k] = (level->axes[k].bricks + PAGE - 1) / PAGE;
            all *= level->pages[k];
        }
        CHECK(all < MAX_PAGES, STATUS_BAD_INPUT,
              "a window of %d x %d x %d cells of %g m: too many; use larger cells or a smaller window",
              grid_elements(level, 0), grid_elements(level, 1), grid_elements(level, 2), level->axes[0].smallest);
        level->page = calloc((size_t)all, sizeof *level->page);
        CHECK(level->page, STATUS_MEMORY, "no memory for a window of %g pages", all);
    }
    return status_ok();
}

static status make_page(grids *g, int level, int index)
{
    if (g->pages == g->room) {
        const int room = 2 * g->room + 64;
        uint8_t *active = realloc(g->active, (size_t)room * PAGE_FLAGS);
        if (active) g->active = active;
        uint8_t *before = realloc(g->before, (size_t)room * PAGE_FLAGS);
        if (before) g->before = before;
        grid_page *page = realloc(g->page, (size_t)room * sizeof *page);
        if (page) g->page = page;
        CHECK(active && before && page, STATUS_MEMORY, "no memory for %d pages of the grid", room);
        g->room = room;
    }
    memset(g->active + (size_t)g->pages * PAGE_FLAGS, 0, PAGE_FLAGS);
    memset(g->before + (size_t)g->pages * PAGE_FLAGS, 0, PAGE_FLAGS);
    g->page[g->pages] = (grid_page){ level, index };
    g->level[level].page[index] = ++g->pages;
    return status_ok();
}

/* Of what has n an axis of a page. */
static status add_slot(grids *g, int level, const int at[3], int n, int *slot)
{
    const int index = grid_page_index(&g->level[level], at, n);
    if (!g->level[level].page[index]) TRY(make_page(g, level, index));
    *slot = grids_slot(g, level, at, n);
    return status_ok();
}

status mpm_grids_add_place(grids *g, int level, const int at[3], int *place)
{
    return add_slot(g, level, at, PAGE, place);
}

status mpm_grids_take_pages(grids *g, const grid_page *page, int pages)
{
    for (int i = 0; i < g->pages; i++) g->level[g->page[i].level].page[g->page[i].index] = 0;
    g->pages = 0;
    for (int i = 0; i < pages; i++) {
        const grid_level *l = page[i].level >= 0 && page[i].level < g->levels ? &g->level[page[i].level] : NULL;
        CHECK(l && page[i].index >= 0 && page[i].index < l->pages[0] * l->pages[1] * l->pages[2] &&
                  !l->page[page[i].index],
              STATUS_IO, "the checkpoint holds a page of the grid that the scene lacks");
        TRY(make_page(g, page[i].level, page[i].index));
    }
    return status_ok();
}

static int element_at(const axis *a, double x)
{
    const int node = mpm_axis_locate(a, x);
    if (node < 1) return 0;
    const int element = node > a->last || x < a->node[node] ? node - 2 : node - 1;
    return grid_clamp(element, a->last - 1);
}

static status activate(grids *g, int level, const int lo[3], const int hi[3])
{
    for (int z = lo[2]; z <= hi[2]; z++)
        for (int y = lo[1]; y <= hi[1]; y++)
            for (int x = lo[0]; x <= hi[0]; x++) {
                int flag;
                TRY(add_slot(g, level, (const int[3]){ x, y, z }, PAGE_GRANULES, &flag));
                g->active[flag] = GRANULE_LIFE;
            }
    return status_ok();
}

status mpm_grids_activate(grids *g, int level, const double lo[3], const double hi[3])
{
    int first[3], last[3];
    if (level == g->levels - 1) return status_ok();
    for (int k = 0; k < 3; k++) {
        const axis *a = &g->level[level].axes[k];
        const double tiny = ROUND * a->smallest;
        if (!(hi[k] > a->node[1] && lo[k] < a->node[a->last])) return status_ok();
        first[k] = element_at(a, lo[k] + tiny) / GRANULE, last[k] = element_at(a, hi[k] - tiny) / GRANULE;
    }
    return activate(g, level, first, last);
}

/* A granule's parent and those within two of it. */
static status activate_around(grids *g, int level, const int at[3])
{
    int lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
        const int parents = grid_elements(&g->level[level + 1], k);
        lo[k] = grid_clamp(at[k] - 2, parents) / GRANULE, hi[k] = grid_clamp(at[k] + 2, parents) / GRANULE;
    }
    return activate(g, level + 1, lo, hi);
}

static status nest_page(grids *g, int level, const int page_at[3], int number)
{
    enum { N = PAGE_GRANULES };
    for (int i = 0; i < PAGE_FLAGS; i++) {
        const int at[3] = { N * page_at[0] + i % N, N * page_at[1] + i / N % N, N * page_at[2] + i / (N * N) };
        if (g->active[(number - 1) * PAGE_FLAGS + i]) TRY(activate_around(g, level, at));
    }
    return status_ok();
}

status mpm_grids_nest(grids *g)
{
    for (int i = 0; i + 2 < g->levels; i++) {
        const grid_level *l = &g->level[i];
        int at[3], n = 0;
        for (at[2] = 0; at[2] < l->pages[2]; at[2]++)
            for (at[1] = 0; at[1] < l->pages[1]; at[1]++)
                for (at[0] = 0; at[0] < l->pages[0]; at[0]++, n++)
                    if (l->page[n]) TRY(nest_page(g, i, at, l->page[n]));
    }
    return status_ok();
}

/* ---- */

int mpm_grids_level_for(const mpm_scene *s, double cell)
{
    int level = 0;
    const double fine = fmax(s->axis[0].fine, fmax(s->axis[1].fine, s->axis[2].fine));
    for (double h = 2 * fine; h <= cell * (1 + 1e-9) && level < s->levels - 1; h *= 2) level++;
    return level;
}

status mpm_grids_activate_zone(grids *g, const mpm_scene *s)
{
    double lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
        const mpm_axis *a = &s->axis[k];
        lo[k] = a->fine_lo + s->grid_shift[k] * a->fine, hi[k] = a->fine_hi + s->grid_shift[k] * a->fine;
    }
    return mpm_grids_activate(g, isnan(s->zone_cell) ? 0 : mpm_grids_level_for(s, s->zone_cell), lo, hi);
}

static status make(const mpm_scene *s, grids *out)
{
    for (int k = 0; k < 3; k++) TRY(make_axes(s, k, out));
    TRY(make_tables(out));
    if (s->zone_until > 0) TRY(mpm_grids_activate_zone(out, s));
    return mpm_grids_nest(out);
}

status mpm_grids_make(const mpm_scene *s, grids *out)
{
    memset(out, 0, sizeof *out);
    CHECK(s->levels >= 1 && s->levels <= MPM_MAX_LEVELS, STATUS_BAD_INPUT, "levels = %d: must be 1 .. %d", s->levels,
          MPM_MAX_LEVELS);
    CHECK(s->levels == 1 || s->basis == MPM_BASIS_GIMP, STATUS_BAD_INPUT, "levels = %d: several need the basis gimp",
          s->levels);
    out->levels = s->levels;
    const status r = make(s, out);
    if (r.code != STATUS_OK) mpm_grids_free(out);
    return r;
}

void mpm_grids_free(grids *g)
{
    for (int i = 0; i < g->levels; i++) {
        for (int k = 0; k < 3; k++) mpm_axis_free(&g->level[i].axes[k]);
        free(g->level[i].page);
        g->level[i].page = NULL;
    }
    free(g->active), free(g->before), free(g->page);
    g->active = g->before = NULL, g->page = NULL;
    g->pages = g->room = 0;
}

int mpm_grids_level(const grids *g, const double x[3])
{
    int element[3], i = 0;
    if (g->levels == 1) return 0;
    for (int k = 0; k < 3; k++) element[k] = element_at(&g->level[0].axes[k], x[k]);
    for (; i < g->levels - 1; i++) {
        const int shift = i + 1; /* an element's granule of its level: half its number */
        if (granule_is_active(g, i, element[0] >> shift, element[1] >> shift, element[2] >> shift)) break;
    }
    return i;
}
