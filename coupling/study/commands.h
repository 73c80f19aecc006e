/* What the commands of the program do, one function a command; main.c says which, with what, and prints.
 *
 * A command fills its part of the summary; what it borrows stays valid until study_command_free. */
#ifndef BREECH_COUPLING_COMMANDS_H
#define BREECH_COUPLING_COMMANDS_H

#include "circuit/rails/inductance.h"
#include "coupling/study/compare.h"

typedef struct {
    run_summary summary; /* borrows what follows */
    shot_record shot;
    double *fire_at; /* of the shot, owned */
    scene_result scene;
    onset_answer onset;
    compare_answer compare;
    inductance_result inductance;
    double *gradients;          /* of the inductance result, owned */
    inductance_surface surface; /* likewise */
} command_result;

status study_command_shot(session *s, command_result *out);
status study_command_scene(session *s, command_result *out);
status study_command_onset(session *s, command_result *out);
status study_command_compare(session *s, command_result *out);
status study_command_inductance(session *s, command_result *out);
void study_command_free(command_result *r);

/* What only making the scenes can tell: STATUS_BAD_INPUT before anything is written.  needs: sum of CASE_FOR_... */
status study_command_possible(const breech_case *c, unsigned needs);

/* `breech check`: what each scene the case leads to would take. */
typedef struct {
    char what[80];
    mpm_needs needs;
    double steps;      /* of the finest level */
    double seconds[2]; /* at CHECK_SECONDS_A_STEP on this machine's threads; [2] everywhere: as mpm_needs */
} scene_estimate;
enum { CHECK_MAX_ESTIMATES = 3 };
#define CHECK_SECONDS_A_STEP 200e-9 /* one thread */

/* The scene of the case, and of its first site the slowest and finest of the search; *n of them. */
status study_command_check(const breech_case *c, int threads, scene_estimate out[CHECK_MAX_ESTIMATES], int *n);

#endif
