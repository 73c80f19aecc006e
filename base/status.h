/* SPDX-License-Identifier: BSD-3-Clause */
/* Status: how every function of Breech that can fail says so.
 *
 * A status is returned by value; code BASE_STATUS_OK means done.  The text is one sentence for the user: what went
 * wrong,
 * the value, its unit, the valid range, what to do.  Only main() prints it and exits.  `assert` is for our own bugs. */
#ifndef BREECH_BASE_STATUS_H
#define BREECH_BASE_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    BASE_STATUS_OK = 0,
    BASE_STATUS_BAD_INPUT, /* the user's input: exit code 2 */
    BASE_STATUS_NUMERICAL, /* the run went wrong: exit code 1 */
    BASE_STATUS_MEMORY,    /* out of memory: exit code 1 */
    BASE_STATUS_IO,        /* a file could not be read or written: exit code 1 */
    BASE_STATUS_STOPPED    /* stopped early on request, with a checkpoint: exit code 75 */
} base_status_code;

typedef struct {
    base_status_code code;
    char text[500];
} base_status;

static inline base_status base_status_ok(void)
{
    const base_status s = { BASE_STATUS_OK, "" };
    return s;
}

base_status base_status_error(base_status_code code, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* BASE_CHECK(cond, code, "format", ...): returns an error from the calling function unless cond holds. */
#define BASE_CHECK(cond, code, ...)                                 \
    do {                                                            \
        if (!(cond)) return base_status_error((code), __VA_ARGS__); \
    } while (0)

/* BASE_TRY(call): returns the error of `call` from the calling function, if it has one. */
#define BASE_TRY(call)                                              \
    do {                                                            \
        const base_status try_status_ = (call);                     \
        if (try_status_.code != BASE_STATUS_OK) return try_status_; \
    } while (0)

/* Names without a prefix are for Breech's own sources alone. */
#ifdef BREECH_INSIDE
typedef base_status status;
typedef base_status_code status_code;
#define status_ok base_status_ok
#define STATUS_OK BASE_STATUS_OK
#define STATUS_BAD_INPUT BASE_STATUS_BAD_INPUT
#define STATUS_NUMERICAL BASE_STATUS_NUMERICAL
#define STATUS_MEMORY BASE_STATUS_MEMORY
#define STATUS_IO BASE_STATUS_IO
#define STATUS_STOPPED BASE_STATUS_STOPPED
#define CHECK BASE_CHECK
#define TRY BASE_TRY
#endif

#ifdef __cplusplus
}
#endif

#endif
