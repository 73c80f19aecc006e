/* SPDX-License-Identifier: BSD-3-Clause */
/* Status: how every function of Breech that can fail says so.
 *
 * A status is returned by value; code STATUS_OK means done.  The text is one sentence for the user: what went wrong,
 * the value, its unit, the valid range, what to do.  Only main() prints it and exits.  `assert` is for our own bugs. */
#ifndef BREECH_BASE_STATUS_H
#define BREECH_BASE_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    STATUS_OK = 0,
    STATUS_BAD_INPUT, /* the user's input: exit code 2 */
    STATUS_NUMERICAL, /* the run went wrong: exit code 1 */
    STATUS_MEMORY,    /* out of memory: exit code 1 */
    STATUS_IO,        /* a file could not be read or written: exit code 1 */
    STATUS_STOPPED    /* stopped early on request, with a checkpoint: exit code 75 */
} status_code;

typedef struct {
    status_code code;
    char text[500];
} status;

static inline status status_ok(void)
{
    const status s = { STATUS_OK, "" };
    return s;
}

status base_status_error(status_code code, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* BASE_CHECK(cond, code, "format", ...): returns an error from the calling function unless cond holds. */
#define BASE_CHECK(cond, code, ...)                                 \
    do {                                                            \
        if (!(cond)) return base_status_error((code), __VA_ARGS__); \
    } while (0)

/* BASE_TRY(call): returns the error of `call` from the calling function, if it has one. */
#define BASE_TRY(call)                                         \
    do {                                                       \
        const status try_status_ = (call);                     \
        if (try_status_.code != STATUS_OK) return try_status_; \
    } while (0)

/* Names without a prefix are for Breech's own sources alone. */
#ifdef BREECH_INSIDE
#define CHECK BASE_CHECK
#define TRY BASE_TRY
#endif

#ifdef __cplusplus
}
#endif

#endif
