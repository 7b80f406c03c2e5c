/* SPDX-License-Identifier: MIT */
/* Does every walk visit every member? The walks are compiled here with -fpack-struct=1. A structure
 * without padding is as large as its members. */
#include <stddef.h>

#include "fields_app.h"
#include "fields_drive.h"
#include "laws.h"
#include "unity.h"

static union {
    law_constants_t law;
    drive_config_t  drive;
    app_config_t    app;
} constants;

static size_t        visited;   /* octets inside `constants` */
static size_t        elsewhere; /* numbers that a walk copies: enumerations */
static unsigned char seen[sizeof constants];

void setUp(void)
{
    visited   = 0U;
    elsewhere = 0U;
    for (size_t n = 0U; n < sizeof seen; n++) {
        seen[n] = 0U;
    }
}

void tearDown(void) {}

static size_t size_of(fields_kind_t kind)
{
    switch (kind) {
    case FIELDS_U16:
    case FIELDS_I16:
        return sizeof(uint16_t);
    case FIELDS_FLAG:
        return sizeof(bool);
    case FIELDS_U32:
    case FIELDS_FLOAT:
        break;
    }
    return sizeof(uint32_t);
}

static void begin(void *self, const char *name)
{
    (void)self;
    TEST_ASSERT_NOT_NULL(name);
}

static void end(void *self)
{
    (void)self;
}

static void number(void *self, const char *name, fields_kind_t kind, const void *x)
{
    const unsigned char *first = (const unsigned char *)&constants;
    const unsigned char *here  = x;

    (void)self;
    (void)name;
    if ((here < first) || (here >= &first[sizeof constants])) {
        elsewhere++;
        return;
    }
    const size_t at = (size_t)(here - first);
    for (size_t n = 0U; n < size_of(kind); n++) {
        TEST_ASSERT_EQUAL_UINT8_MESSAGE(0U, seen[at + n], "visited twice");
        seen[at + n] = 1U;
        visited++;
    }
}

static fields_t walk(void)
{
    static const fields_listener_t listener = {
        .self = NULL, .begin = begin, .end = end, .number = number};

    return fields_told(&listener);
}

static void assert_law(void (*fields)(fields_t *, void *), size_t size, size_t enumerations)
{
    fields_t f = walk();

    setUp();
    fields(&f, &constants.law);
    TEST_ASSERT_EQUAL_size_t(enumerations, elsewhere);
    TEST_ASSERT_EQUAL_size_t(size, visited + (enumerations * sizeof(nodo_harmonic_channel_t)));
}

static void test_every_constant_of_every_law_is_visited_once(void)
{
    assert_law(law_noc_fields, sizeof(law_noc_config_t), 0U);
    assert_law(law_noc_speed_fields, sizeof(law_noc_speed_config_t), 0U);
    assert_law(law_noc_h_fields, sizeof(law_noc_h_config_t), NODO_HARMONIC_PAIRS_MAX);
    assert_law(law_noc_iron_fields, sizeof(law_noc_iron_config_t), 0U);
    assert_law(law_noc_shaft_fields, sizeof(law_noc_shaft_config_t), 0U);
    assert_law(law_conventional_fields, sizeof(law_conventional_config_t), 0U);
    assert_law(law_dobc_fields, sizeof(law_dobc_config_t), 0U);
    assert_law(law_pid_fields, sizeof(law_pid_config_t), 0U);
    assert_law(law_pi_foc_fields, sizeof(law_pi_foc_config_t), 0U);
    assert_law(law_ladrc_fields, sizeof(law_ladrc_config_t), 0U);
}

static void test_every_constant_of_the_drive_is_visited_once(void)
{
    fields_t f = walk();

    fields_drive(&f, &constants.drive);
    TEST_ASSERT_EQUAL_size_t(0U, elsewhere);
    TEST_ASSERT_EQUAL_size_t(sizeof(drive_config_t), visited + (2U * sizeof(void *)));
}

/* The image holds what three pointers point to. */
static void test_every_constant_of_the_application_is_visited_once(void)
{
    fields_t f = walk();

    fields_app(&f, &constants.app);
    TEST_ASSERT_EQUAL_size_t(1U, elsewhere); /* stop.reaction */
    TEST_ASSERT_EQUAL_size_t(sizeof(app_config_t),
                             visited + sizeof(app_stop_reaction_t) + (3U * sizeof(void *)));
}

typedef struct {
    int16_t order;
    float   gain;
    bool    exact;
} own_t;

static void own_fields(fields_t *f, void *own)
{
    own_t *c = own;

    fields_i16(f, FIELD(f, c, order));
    fields_float(f, FIELD(f, c, gain));
    fields_flag(f, FIELD(f, c, exact));
}

static void forgetful_fields(fields_t *f, void *own)
{
    own_t *c = own;

    fields_float(f, FIELD(f, c, gain));
    fields_flag(f, FIELD(f, c, exact));
}

/* An integer before a float would hide in the padding. */
static void test_a_forgotten_constant_is_seen(void)
{
    fields_t f = walk();

    assert_law(own_fields, sizeof(own_t), 0U);
    setUp();
    forgetful_fields(&f, &constants.law);
    TEST_ASSERT_EQUAL_size_t(sizeof(own_t) - sizeof(int16_t), visited);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_constant_of_every_law_is_visited_once);
    RUN_TEST(test_every_constant_of_the_drive_is_visited_once);
    RUN_TEST(test_every_constant_of_the_application_is_visited_once);
    RUN_TEST(test_a_forgotten_constant_is_seen);
    return UNITY_END();
}
