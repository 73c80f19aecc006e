/* SPDX-License-Identifier: BSD-3-Clause */
/* Families of grains and the search of their thresholds, by scenes (scenes.h).
 *
 * A family is what surface.h means by it: the grains of a case - sites of its list and populations - that are alike in
 * shape, material, bond and height over radius.  All searches of a study, over families and over cases (rail surfaces),
 * go on side by side: each says which scenes it needs next, is told them as they come and goes on (surface.h); run/
 * gets the needed scenes of all, and with more than one process those that may be needed next.
 * With study.judge growth the searches' scenes end once the growth of their groove is known; where something gouges,
 * one or two more at fine cells (study.craters), in the middle of what gouges and at the fastest grain, go on to their
 * whole craters.  A groove that is not followed (scene.follow) has no growth: such a study is judged by severity. */
#ifndef BREECH_COUPLING_FAMILY_H
#define BREECH_COUPLING_FAMILY_H

#include "coupling/gouge/site_state.h"
#include "coupling/run/scenes.h"
#include "coupling/study/search/surface.h"

typedef struct {
    double radius, velocity, cells; /* what was asked for */
    bool whole;                     /* to its end, so that its crater counts; else until its growth was known */
    const scene_record *record;     /* borrowed from the session */
} family_scene;

/* Which of a family's two thresholds, each where another number of its scenes passes zero: judges of the same scenes.
 * Severity knows the first alone. */
typedef enum {
    JUDGE_OF_GOUGE,   /* a gouge: growth and shape (gouge_tear_drop_excess), or severity less its limit */
    JUDGE_OF_SCRATCH, /* a groove that grows, whatever its shape: growth */
    FAMILY_JUDGES
} family_judge;

/* With the place of the grid, standard deviations: of what passes zero [1], of the threshold by that [m/s].  0: not
 * asked for, or there is no threshold; NAN: the second one is not known.  Then `reach` is how far from the threshold
 * scenes are that decide beyond the first one, else it is the second one: by this the interval is wider [m/s].
 * more: how far the mean over the grids lies above the search's own threshold; 0 where the second one is not known
 * [m/s].
 * against: where the search saw one side alone, the velocity of the first scene that decides otherwise on a further
 * grid; the interval's known end lies before it.  0: none [m/s]. */
typedef struct {
    double excess, threshold, reach, more, against;
} family_scatter;

enum { WHOLE_SCENES_SIZE = 120 };

typedef struct {
    case_site grain; /* of its first site or population; the size is the scene's */
    double aspect;   /* height over radius */
    bool by_growth;  /* else by severity: study_family_probe */
    bool scratch;    /* has a scratch velocity too */
    surface_plan plan, scratch_plan;
    surface_result surface;   /* of the gouge */
    surface_result scratches; /* of the scratch; nothing without it */
    family_scatter scatter, scratch_scatter;
    /* What whole scenes are where growth says that it gouges for sure; "": they agree. */
    char contradicted[WHOLE_SCENES_SIZE];
    int n_scenes;
    family_scene scene[THRESHOLD_MAX_SAMPLES];
} grain_family;

/* The grains of one case in one shot. */
typedef struct {
    const case_onset *c;                    /* borrowed */
    case_impact probe, whole;               /* what the searches' scenes are made of, and those that go to their end */
    const shot_outcome *flown;              /* borrowed */
    const char *prefix;                     /* of its scenes' names, "" for the case as it is; borrowed */
    char surface[BASE_PARAM_TEXT_SIZE + 4]; /* before its warnings: "hardened: "; "": it is the only one */
    bool scratch;                           /* their searches look for the scratch velocity too */
    int n;
    grain_family *family;         /* owned */
    int *of_site, *of_population; /* index of the family, -1: needs no scene; owned */
    int screened, too_small;      /* sites and populations without a scene: by the screen, by study.smallest_radius */
    int unbacked; /* of the screened: no scene was run for grains alike either, the screen alone speaks for them */
    double screen_probability; /* that one of the unbacked gouges: the largest; 0: there are none [1] */
} grain_families;

/* Kinds of grains among sites and populations, alike in all but size: at most so many families. */
int study_family_kinds(const case_onset *c);

/* Sorts sites and populations into families and plans their searches, of the gouge alone.  study_families_free even on
 * error. */
status study_families_sort(const case_onset *c, const shot_outcome *flown, const char *prefix, grain_families *out);
void study_families_free(grain_families *f);

/* Before the search: it looks for the scratch velocity too, where the study asks for one and is judged by growth. */
void study_families_want_scratch(grain_families *f);

/* What a search's scenes are made of: they end at their second gauge where the study is judged by growth, and else go
 * to their end. */
case_impact study_family_probe(const case_onset *c);

/* Searches all families of n cases to their end. */
status study_families_search(session *s, grain_families *const *f, int n);

/* That of a site, whether the screen skips it or not: an index, -1: no grain alike has scenes, or it is not reached. */
int study_family_of_site(const grain_families *f, int site);

/* Its family in another case of the same grains; NULL: none of them is fast enough there (screen). */
grain_family *study_family_alike(const grain_families *in, const grain_family *f);

/* The scene as the searches ask for it; k: of its family. */
scene_query study_family_query(const grain_families *f, int k, const family_scene *scene);
/* What a scene says to a judge: its excess passes zero at the threshold [1], its class is `gouge` above. */
threshold_sample study_family_sample(const case_onset *c, family_judge judge, const onset_scene *e);

/* The answer of a family's search for one of its thresholds, and its scatter. */
surface_result *study_family_surface(grain_family *f, family_judge judge);
family_scatter *study_family_scatter(grain_family *f, family_judge judge);

/* Is it of the search?  Judged by growth, whole scenes are not. */
bool study_family_searched(const grain_family *f, const family_scene *scene);

/* Of the search's that of the best resolution nearest in velocity, of those nearest in size; NULL if there is none. */
const family_scene *study_family_nearest(const grain_family *f, double radius, double velocity);

#endif
