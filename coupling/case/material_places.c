/* SPDX-License-Identifier: BSD-3-Clause */
/* Where materials and shipped cases are. */
#include "coupling/case/material_file.h"

#include "coupling/host/file_text.h"
#include "coupling/host/words.h"

#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool case_material_name_valid(const char *name)
{
    if (name[0] == '\0' || name[0] == '.' || strlen(name) >= BASE_PARAM_TEXT_SIZE) return false;
    for (; *name; name++)
        if (!isalnum((unsigned char)*name) && !strchr("_-+.", *name)) return false;
    return true;
}

/* The build says where the cases are; without it there is only the environment. */
#ifndef BREECH_SOURCE_CASES
#define BREECH_SOURCE_CASES "cases"
#endif
#ifndef BREECH_INSTALLED_CASES /* from the program's folder */
#define BREECH_INSTALLED_CASES "../share/breech/cases"
#endif

/* The cases of the installation; "" where the system does not say where the program lies. */
static void beside_program(char path[MATERIAL_PATH_SIZE])
{
    static const char within[] = "/" BREECH_INSTALLED_CASES;
    const ssize_t n = readlink("/proc/self/exe", path, MATERIAL_PATH_SIZE - sizeof within);
    path[n > 0 ? n : 0] = '\0';
    char *slash = strrchr(path, '/');
    if (slash) memcpy(slash, within, sizeof within);
    char *plain = realpath(path, NULL); /* without the dots */
    snprintf(path, MATERIAL_PATH_SIZE, "%s", plain ? plain : "");
    free(plain);
}

void case_folders_find(case_folders *out)
{
    beside_program(out->installed);
    const char *const all[] = { out->installed, BREECH_SOURCE_CASES };
    out->n = 0;
    for (int k = 0; k < CASE_MAX_FOLDERS; k++)
        if (host_folder_exists(all[k])) out->dir[out->n++] = all[k];
}

status case_material_places_find(material_places *out)
{
    const char *own = getenv("BREECH_MATERIALS");
    char cases[MATERIAL_PATH_SIZE];
    beside_program(cases);
    snprintf(out->installed, sizeof out->installed, "%.*s/materials", MATERIAL_PATH_SIZE - 11, cases);
    const char *const all[] = { own && own[0] ? own : NULL, out->installed, BREECH_SOURCE_CASES "/materials" };
    out->n = 0;
    CHECK(!all[0] || host_folder_exists(all[0]), STATUS_BAD_INPUT,
          "BREECH_MATERIALS=%.300s: there is no such folder of materials", all[0]);
    for (int k = 0; k < MATERIAL_MAX_DIRS; k++)
        if (all[k] && host_folder_exists(all[k])) out->dir[out->n++] = all[k];
    return status_ok();
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

void case_material_names_free(char **names, int n)
{
    for (int k = 0; k < n; k++) free(names[k]);
    free(names);
}

static status add_name(char ***names, int *n, const char *file)
{
    const size_t length = strlen(file);
    if (length <= 5 || strcmp(file + length - 5, ".yaml") != 0) return status_ok();
    char **more = realloc(*names, ((size_t)*n + 1) * sizeof *more);
    CHECK(more, STATUS_MEMORY, "out of memory while listing materials");
    *names = more;
    more[*n] = strndup(file, length - 5);
    CHECK(more[*n], STATUS_MEMORY, "out of memory while listing materials");
    if (case_material_name_valid(more[*n]))
        (*n)++;
    else
        free(more[*n]);
    return status_ok();
}

status case_material_names(const char *dir, char ***names, int *n)
{
    *names = NULL;
    *n = 0;
    DIR *folder = opendir(dir);
    if (!folder) return status_ok();
    status s = status_ok();
    for (struct dirent *entry; s.code == STATUS_OK && (entry = readdir(folder));) s = add_name(names, n, entry->d_name);
    closedir(folder);
    if (s.code != STATUS_OK) {
        case_material_names_free(*names, *n);
        *names = NULL;
        *n = 0;
        return s;
    }
    if (*n > 0) qsort(*names, (size_t)*n, sizeof **names, by_name);
    return s;
}

static const char *listed(const void *user, int i)
{
    return ((char *const *)user)[i];
}

/* What may have been meant by a name: the nearest one, or all that have it in them. */
typedef struct {
    char nearest[BASE_PARAM_TEXT_SIZE], holding[160];
} name_hints;

static void add_hints(const char *name, char *const *names, name_hints *h)
{
    const char *found = host_nearest_name(name, listed, names);
    if (found) snprintf(h->nearest, sizeof h->nearest, "%s", found);
    for (; *names; names++) {
        const size_t used = strlen(h->holding);
        if (!strstr(*names, name) || used + strlen(*names) + 5 > sizeof h->holding) continue;
        snprintf(h->holding + used, sizeof h->holding - used, "%s`%s`", used > 0 ? ", " : "", *names);
    }
}

static status not_found(const char *name, const char *const *dirs, int n_dirs)
{
    char text[400] = "";
    name_hints h = { "", "" };
    for (int d = 0; d < n_dirs; d++) {
        char **names;
        int n;
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "%s%s", d > 0 ? ", " : "", dirs[d]);
        TRY(case_material_names(dirs[d], &names, &n));
        char **ended = realloc(names, ((size_t)n + 1) * sizeof *ended);
        if (ended) {
            names = ended;
            names[n] = NULL;
            add_hints(name, names, &h);
        }
        case_material_names_free(names, n);
    }
    const char *meant = h.nearest[0] ? h.nearest : h.holding, *quote = h.nearest[0] ? "`" : "";
    return base_status_error(STATUS_BAD_INPUT, "no material of this name in %s; %s%s%s%s%s",
                             n_dirs > 0 ? text : "(no folder given)",
                             meant[0] ? "did you mean " : "`breech materials` lists those at hand", quote, meant, quote,
                             meant[0] ? "?" : "");
}

status case_material_file_find(const char *name, const char *const *dirs, int n_dirs, char path[MATERIAL_PATH_SIZE])
{
    CHECK(case_material_name_valid(name), STATUS_BAD_INPUT, "a material's name has letters, digits, _ - + . only");
    for (int d = 0; d < n_dirs; d++) {
        if (snprintf(path, MATERIAL_PATH_SIZE, "%s/%s.yaml", dirs[d], name) >= MATERIAL_PATH_SIZE) continue;
        if (host_file_exists(path)) return status_ok();
    }
    return not_found(name, dirs, n_dirs);
}
