/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/dae.h"

#include "circuit/sundials_compat.h"

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

struct dae {
    dae_problem problem;
    SUNContext context;
    N_Vector y, yp, atol, differential;
    SUNMatrix matrix;
    SUNLinearSolver solver;
    void *ida;
    int *direction, *found;
    double t;
};

static int residual(sunrealtype t, N_Vector y, N_Vector yp, N_Vector r, void *user)
{
    const dae *d = user;
    d->problem.residual(d->problem.model, t, N_VGetArrayPointer(y), N_VGetArrayPointer(yp), N_VGetArrayPointer(r));
    return 0;
}

static int roots(sunrealtype t, N_Vector y, N_Vector yp, sunrealtype *g, void *user)
{
    const dae *d = user;
    (void)yp;
    d->problem.roots(d->problem.model, t, N_VGetArrayPointer(y), g);
    return 0;
}

/* ---- the matrix and its solver, as SUNDIALS wants them: both hold the problem's arrow ---- */

static SUNMatrix_ID matrix_id(SUNMatrix A)
{
    (void)A;
    return SUNMATRIX_CUSTOM;
}

static int matrix_zero(SUNMatrix A)
{
    circuit_arrow_clear(A->content);
    return 0;
}

static SUNLinearSolver_Type solver_type(SUNLinearSolver S)
{
    (void)S;
    return SUNLINEARSOLVER_DIRECT;
}

static int solver_setup(SUNLinearSolver S, SUNMatrix A)
{
    (void)S;
    return circuit_arrow_factor(A->content);
}

static int solver_solve(SUNLinearSolver S, SUNMatrix A, N_Vector x, N_Vector b, sunrealtype tolerance)
{
    (void)S;
    (void)tolerance;
    if (x != b) N_VScale(1.0, b, x);
    circuit_arrow_solve(A->content, N_VGetArrayPointer(x));
    return 0;
}

static int jacobian(sunrealtype t, sunrealtype cj, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix J, void *user,
                    N_Vector tmp1, N_Vector tmp2, N_Vector tmp3)
{
    const dae *d = user;
    (void)yp;
    (void)r;
    (void)tmp1;
    (void)tmp2;
    (void)tmp3;
    d->problem.jacobian(d->problem.model, t, cj, N_VGetArrayPointer(y), J->content);
    return 0;
}

static bool algebra_create(dae *d)
{
    d->matrix = SUNMatNewEmpty(d->context);
    d->solver = SUNLinSolNewEmpty(d->context);
    if (!d->matrix || !d->solver) return false;
    d->matrix->content = d->problem.matrix;
    d->matrix->ops->getid = matrix_id;
    d->matrix->ops->zero = matrix_zero;
    d->solver->ops->gettype = solver_type;
    d->solver->ops->setup = solver_setup;
    d->solver->ops->solve = solver_solve;
    return true;
}

static status failure(int flag, double t)
{
    char *name = IDAGetReturnFlagName(flag);
    const status st =
        base_status_error(STATUS_NUMERICAL,
                          "the circuit's integration failed at t = %.9g s (%s): try a larger options.rtol, and "
                          "check for zero inductances or extreme values",
                          t, name ? name : "unknown");
    free(name);
    return st;
}

static status vectors_create(dae *d)
{
    const int n = d->problem.n, n_roots = d->problem.n_roots;
    CHECK(SUNContext_Create(COMPAT_NO_COMM, &d->context) == 0, STATUS_MEMORY, "out of memory for the circuit's solver");
    d->y = N_VNew_Serial(n, d->context);
    d->yp = N_VNew_Serial(n, d->context);
    d->atol = N_VNew_Serial(n, d->context);
    d->differential = N_VNew_Serial(n, d->context);
    d->direction = calloc((size_t)n_roots + 1, sizeof *d->direction);
    d->found = calloc((size_t)n_roots + 1, sizeof *d->found);
    d->ida = IDACreate(d->context);
    CHECK(d->y && d->yp && d->atol && d->differential && d->direction && d->found && d->ida && algebra_create(d),
          STATUS_MEMORY, "out of memory for a circuit of %d unknowns", n);
    return status_ok();
}

static status solver_create(dae *d)
{
    N_VConst(0.0, d->y);
    N_VConst(0.0, d->yp);
    N_VConst(1.0, d->atol);
    N_VConst(1.0, d->differential);
    (void)COMPAT_SILENCE(d->context, d->ida);
    int bad = IDAInit(d->ida, residual, 0.0, d->y, d->yp);
    if (!bad) bad = IDASetUserData(d->ida, d);
    if (!bad) bad = IDASVtolerances(d->ida, 1e-6, d->atol);
    if (!bad) bad = IDASetLinearSolver(d->ida, d->solver, d->matrix);
    if (!bad) bad = IDASetJacFn(d->ida, jacobian);
    if (!bad) bad = IDASetSuppressAlg(d->ida, 1);
    if (!bad) bad = IDARootInit(d->ida, d->problem.n_roots, roots);
    if (!bad) bad = IDASetNoInactiveRootWarn(d->ida);
    CHECK(!bad, STATUS_MEMORY, "the circuit's solver could not be set up (code %d)", bad);
    return status_ok();
}

status circuit_dae_create(const dae_problem *problem, dae **out)
{
    *out = NULL;
    dae *d = calloc(1, sizeof *d);
    CHECK(d, STATUS_MEMORY, "out of memory for the circuit's solver");
    d->problem = *problem;
    status st = vectors_create(d);
    if (st.code == STATUS_OK) st = solver_create(d);
    if (st.code != STATUS_OK) {
        circuit_dae_free(d);
        return st;
    }
    *out = d;
    return st;
}

void circuit_dae_free(dae *d)
{
    if (!d) return;
    if (d->ida) IDAFree(&d->ida);
    if (d->solver) SUNLinSolFreeEmpty(d->solver);
    if (d->matrix) SUNMatFreeEmpty(d->matrix);
    if (d->y) N_VDestroy(d->y);
    if (d->yp) N_VDestroy(d->yp);
    if (d->atol) N_VDestroy(d->atol);
    if (d->differential) N_VDestroy(d->differential);
    if (d->context) SUNContext_Free(&d->context);
    free(d->direction);
    free(d->found);
    free(d);
}

double *circuit_dae_y(const dae *d)
{
    return N_VGetArrayPointer(d->y);
}

double *circuit_dae_yp(const dae *d)
{
    return N_VGetArrayPointer(d->yp);
}

double *circuit_dae_atol(const dae *d)
{
    return N_VGetArrayPointer(d->atol);
}

double *circuit_dae_differential(const dae *d)
{
    return N_VGetArrayPointer(d->differential);
}

int *circuit_dae_direction(const dae *d)
{
    return d->direction;
}

const int *circuit_dae_found(const dae *d)
{
    return d->found;
}

status circuit_dae_restart(dae *d, double t, double rtol, double first)
{
    d->t = t;
    int flag = IDAReInit(d->ida, t, d->y, d->yp);
    if (flag >= 0) flag = IDASVtolerances(d->ida, rtol, d->atol);
    if (flag >= 0) flag = IDASetId(d->ida, d->differential);
    if (flag >= 0) flag = IDASetRootDirection(d->ida, d->direction);
    if (flag >= 0) flag = IDASetInitStep(d->ida, first);
    return flag >= 0 ? status_ok() : failure(flag, t);
}

status circuit_dae_step(dae *d, double stop, double *t, dae_outcome *outcome)
{
    int flag = IDASetStopTime(d->ida, stop);
    if (flag >= 0) flag = IDASolve(d->ida, stop, &d->t, d->y, d->yp, IDA_ONE_STEP);
    if (flag == IDA_ROOT_RETURN && IDAGetRootInfo(d->ida, d->found) < 0) flag = IDA_RTFUNC_FAIL;
    *t = d->t;
    if (flag < 0) return failure(flag, d->t);
    *outcome = flag == IDA_ROOT_RETURN ? DAE_ROOT : flag == IDA_TSTOP_RETURN ? DAE_STOP : DAE_STEP;
    return status_ok();
}
