/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/law/contact.h"

#include <stdio.h>
#include <string.h>

#define CONTACT_BEGIN(name, text) static const base_param params_##name[] = {
#define CONTACT_VALUE(place, key_, unit_, fallback_, least, largest, text) \
    { .key = (key_),                                                       \
      .unit = (unit_),                                                     \
      .doc = (text),                                                       \
      .offset = offsetof(mpm_contact, value[place]),                       \
      .fallback = (fallback_),                                             \
      .min = (least),                                                      \
      .max = (largest),                                                    \
      .kind = BASE_PARAM_NUMBER },
#define CONTACT_END(name) \
    PARAMS_END            \
    }                     \
    ;
#include "mpm/law/contact.def"

static const mpm_contact_law table[] = {
#define CONTACT_BEGIN(name, text) { #name, text, params_##name },
#include "mpm/law/contact.def"
};

const mpm_contact_law *mpm_contact_at(int i)
{
    return i >= 0 && i < (int)CONTACT_LAWS ? &table[i] : NULL;
}

int mpm_contact_index(const mpm_contact_law *law)
{
    return (int)(law - table);
}

const mpm_contact_law *mpm_contact_find(const char *name)
{
    for (int i = 0; i < (int)CONTACT_LAWS; i++)
        if (strcmp(table[i].name, name) == 0) return &table[i];
    return NULL;
}

mpm_contact mpm_contact_of(const mpm_contact_law *law)
{
    mpm_contact c;
    memset(&c, 0, sizeof c);
    c.law = law;
    base_params_default(law->params, &c);
    return c;
}

status mpm_contact_check(const mpm_contact *c)
{
    CHECK(c->law, STATUS_BAD_INPUT, "a contact lacks its law");
    char section[BASE_PARAM_TEXT_SIZE];
    snprintf(section, sizeof section, "contact %s", c->law->name);
    return base_params_check(c->law->params, c, section);
}
