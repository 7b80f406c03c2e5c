/* SPDX-License-Identifier: MIT */
#include "iron.h"

#include "unit_support.h"
#include "unity.h"

#define CASES     4000
#define LIMIT_A   4.0
#define ACCEL     14285.7 /* 1.5 n_p^2 / J of ipmsm_390w */
#define RS_Ohm    2.48
#define TS_s      2.0e-4
#define TOLERANCE 2.0e-6 /* of the largest: single precision */

static iron_map_t            map;
static const motor_reduced_t plain = {.l2 = 0.238f, .l3 = 4761.9f};
static support_random_t      random_state;

/* Fluxes of a table of no real machine; every value differs from node to node. */
static void fill(void)
{
    map.nodes_per_A_d = (float)((IRON_NODES_D - 1) / LIMIT_A);
    map.nodes_per_A_q = (float)((IRON_NODES_Q - 1) / LIMIT_A);
    map.A_per_node_d  = (float)(LIMIT_A / (IRON_NODES_D - 1));
    map.A_per_node_q  = (float)(LIMIT_A / (IRON_NODES_Q - 1));
    map.rs_Ohm        = (float)RS_Ohm;
    map.accel_per_WbA = (float)ACCEL;
    for (int i = 0; i < IRON_NODES_D; i++) {
        for (int j = 0; j < IRON_NODES_Q; j++) {
            const double d = -LIMIT_A * i / (IRON_NODES_D - 1);
            const double q = LIMIT_A * j / (IRON_NODES_Q - 1);
            map.node[i][j][IRON_PSI_D] =
                (float)(0.19 + (0.07 * d) - (0.003 * q * q) - (0.001 * d * q));
            map.node[i][j][IRON_PSI_Q] = (float)((0.11 * q) - (0.004 * q * q) + (0.002 * d * q));
            map.node[i][j][IRON_LD]    = (float)(0.07 + (0.002 * d) - (0.001 * q));
            map.node[i][j][IRON_LQ]    = (float)(0.11 - (0.008 * q) + (0.002 * d));
            map.node[i][j][IRON_LDQ]   = (float)((-0.006 * q) - (0.001 * d * q));
        }
    }
}

void setUp(void)
{
    random_state.state = 71u;
    fill();
}

void tearDown(void) {}

/* The table in double precision, at currents within it. */
typedef struct {
    double id, iq, psi_d, psi_q, ld, lq, m;
} oracle_t;

static double node(int i, int j, int value)
{
    return (double)map.node[i][j][value];
}

static double between(int i, int j, double x, double y, int value)
{
    return ((1.0 - x) * (((1.0 - y) * node(i, j, value)) + (y * node(i, j + 1, value)))) +
           (x * (((1.0 - y) * node(i + 1, j, value)) + (y * node(i + 1, j + 1, value))));
}

static oracle_t oracle(double id_A, double iq_A)
{
    const double id   = -support_limit(-id_A, 0.0, LIMIT_A);
    const double iq   = support_limit(iq_A, -LIMIT_A, LIMIT_A);
    const double sign = (iq_A < 0.0) ? -1.0 : 1.0;
    const double d    = -id * (IRON_NODES_D - 1) / LIMIT_A;
    const double q    = fabs(iq) * (IRON_NODES_Q - 1) / LIMIT_A;
    const int    i    = (d < IRON_NODES_D - 2) ? (int)d : (IRON_NODES_D - 2);
    const int    j    = (q < IRON_NODES_Q - 2) ? (int)q : (IRON_NODES_Q - 2);

    const oracle_t o = {.id    = id,
                        .iq    = iq,
                        .psi_d = between(i, j, d - i, q - j, IRON_PSI_D),
                        .psi_q = sign * between(i, j, d - i, q - j, IRON_PSI_Q),
                        .ld    = between(i, j, d - i, q - j, IRON_LD),
                        .lq    = between(i, j, d - i, q - j, IRON_LQ),
                        .m     = sign * between(i, j, d - i, q - j, IRON_LDQ)};
    return o;
}

static void near(double want, double got, double largest)
{
    TEST_ASSERT_DOUBLE_WITHIN(TOLERANCE * largest, want, got);
}

/* EQ-PLANT-1 to 3 with the fluxes of EQ-IRON-1 near the oracle's currents. */
static void flux_rates(const oracle_t *o, const double x[3], const double v[2], const nodo_t *dis,
                       double rate[3])
{
    const double w     = x[0];
    const double psi_d = o->psi_d + (o->ld * (x[2] - o->id)) + (o->m * (x[1] - o->iq));
    const double psi_q = o->psi_q + (o->lq * (x[1] - o->iq)) + (o->m * (x[2] - o->id));
    const double e_d   = v[0] - (RS_Ohm * x[2]) + (w * psi_q);
    const double e_q   = v[1] - (RS_Ohm * x[1]) - (w * psi_d);
    const double det   = (o->ld * o->lq) - (o->m * o->m);

    rate[0] = (ACCEL * ((psi_d * x[1]) - (psi_q * x[2]))) - (0.238 * w) + (double)dis->d_omega;
    rate[1] = (((o->ld * e_q) - (o->m * e_d)) / det) + (double)dis->d_q;
    rate[2] = (((o->lq * e_d) - (o->m * e_q)) / det) + (double)dis->d_d;
}

static nodo_t draw(double id, double iq)
{
    const nodo_t x = {.d_omega       = support_uniform(&random_state, -8000.0f, 8000.0f),
                      .d_q           = support_uniform(&random_state, -300.0f, 300.0f),
                      .d_d           = support_uniform(&random_state, -300.0f, 300.0f),
                      .omega_e_radps = support_uniform(&random_state, -1000.0f, 1000.0f),
                      .iq_A          = (float)iq,
                      .id_A          = (float)id};
    return x;
}

/* The prediction about the tangent at (id0, iq0), by the midpoint rule in double precision. */
static void assert_prediction(double id0, double iq0, double id, double iq)
{
    const oracle_t       o     = oracle(id0, iq0);
    const iron_tangent_t t     = iron_tangent(&map, &plain, (float)id0, (float)iq0);
    const dq_t           v_V   = {.d = support_uniform(&random_state, -170.0f, 170.0f),
                                  .q = support_uniform(&random_state, -170.0f, 170.0f)};
    const double         v[2]  = {(double)v_V.d, (double)v_V.q};
    nodo_t               x     = draw(id, iq);
    const nodo_t         from  = x;
    float                theta = 3.1f;
    const double         at[3] = {(double)x.omega_e_radps, (double)x.iq_A, (double)x.id_A};
    double               f[3];
    double               middle[3];

    flux_rates(&o, at, v, &from, f);
    for (int k = 0; k < 3; k++) {
        middle[k] = at[k] + (0.5 * TS_s * f[k]);
    }
    flux_rates(&o, middle, v, &from, f);
    iron_predict(&x, &theta, &map, &t, v_V, (float)TS_s);

    near(at[0] + (TS_s * f[0]), (double)x.omega_e_radps, 1000.0);
    near(at[1] + (TS_s * f[1]), (double)x.iq_A, 10.0);
    near(at[2] + (TS_s * f[2]), (double)x.id_A, 10.0);
    near(remainder(3.1 + (TS_s * middle[0]), 2.0 * 3.14159265358979), (double)theta, 3.2);
    TEST_ASSERT_TRUE((x.d_omega == from.d_omega) && (x.d_q == from.d_q) && (x.d_d == from.d_d));
}

/* EQ-IRON-2: at the currents of the look-up, EQ-MOTOR-2 has the voltages and the torque of the fluxes. */
static void assert_motor(double id, double iq)
{
    const oracle_t         o    = oracle(id, iq);
    const iron_tangent_t   t    = iron_tangent(&map, &plain, (float)id, (float)iq);
    const nodo_t           x    = draw(id, iq);
    const nodo_t           seen = iron_estimates(&map, &t, &x);
    const motor_reduced_t *m    = &t.motor;
    const double           w    = (double)x.omega_e_radps;
    const double           accel =
        (((double)m->l1 + ((double)m->l11 * id)) * iq) - ((double)m->l2 * w) + (double)seen.d_omega;
    const double q_Aps =
        (-(double)m->l4 * iq) - ((double)m->l5 * w) - ((double)m->l10 * w * id) + (double)seen.d_q;
    const double d_Aps = (-(double)m->l7 * id) + ((double)m->l9 * w * iq) + (double)seen.d_d;

    near((ACCEL * ((o.psi_d * iq) - (o.psi_q * id))) - (0.238 * w) + (double)x.d_omega, accel,
         2.0e5);
    near(((-RS_Ohm * iq) - (w * o.psi_d)) / o.lq + (double)x.d_q, q_Aps, 2.0e4);
    near(((-RS_Ohm * id) + (w * o.psi_q)) / o.ld + (double)x.d_d, d_Aps, 4.0e4);
    near(o.lq, (double)m->inv_l6, 0.1);
    near(o.ld, (double)m->inv_l8, 0.1);
    near(1.0, (double)m->inv_l6 * (double)m->l6, 2.0);
    near(1.0, (double)m->inv_l8 * (double)m->l8, 2.0);
    near(1.0, (double)m->l9 * (double)m->l10, 10.0);
    near(4761.9, (double)m->l3, 1.0e4);
    /* the slope of the torque over iq */
    near(ACCEL * (o.psi_d + (o.m * iq) - (o.lq * id)), (double)m->l1 + ((double)m->l11 * id),
         2.0e4);
    TEST_ASSERT_TRUE((seen.omega_e_radps == x.omega_e_radps) && (seen.iq_A == x.iq_A) &&
                     (seen.id_A == x.id_A) && (seen.d_q == x.d_q));
}

static void test_motor_has_the_voltages_and_the_torque_of_the_fluxes(void)
{
    for (int n = 0; n < CASES; n++) {
        assert_motor((double)support_uniform(&random_state, -3.999f, 0.0f),
                     (double)support_uniform(&random_state, -3.999f, 3.999f));
    }
}

static void test_every_node_is_itself(void)
{
    for (int i = 0; i < IRON_NODES_D; i++) {
        for (int j = 0; j < IRON_NODES_Q; j++) {
            assert_motor(-LIMIT_A * i / (IRON_NODES_D - 1), LIMIT_A * j / (IRON_NODES_Q - 1));
        }
    }
}

/* The estimates differ from the currents of the tangent, which lie in the table or beyond its edge. */
static void test_prediction_moves_as_the_fluxes_do(void)
{
    for (int n = 0; n < CASES; n++) {
        const double id0 = (double)support_uniform(&random_state, -9.0f, 5.0f);
        const double iq0 = (double)support_uniform(&random_state, -9.0f, 9.0f);
        const double d   = (double)support_uniform(&random_state, -0.5f, 0.5f);
        const double q   = (double)support_uniform(&random_state, -0.5f, 0.5f);

        assert_prediction(id0, iq0, id0 + d, iq0 + q);
    }
}

static void test_negative_q_currents_are_the_mirror_image(void)
{
    for (int n = 0; n < CASES; n++) {
        const float          id = support_uniform(&random_state, -5.0f, 1.0f);
        const float          iq = support_uniform(&random_state, 0.01f, 5.0f);
        const iron_tangent_t a  = iron_tangent(&map, &plain, id, iq);
        const iron_tangent_t b  = iron_tangent(&map, &plain, id, -iq);

        TEST_ASSERT_TRUE((a.psi_q_Wb == -b.psi_q_Wb) && (a.m_H == -b.m_H) && (a.iq_A == -b.iq_A));
        TEST_ASSERT_TRUE((a.psi_d_Wb == b.psi_d_Wb) && (a.id_A == b.id_A) &&
                         (a.inv_det_1pH2 == b.inv_det_1pH2));
        TEST_ASSERT_TRUE((a.motor.l1 == b.motor.l1) && (a.motor.l5 == b.motor.l5) &&
                         (a.motor.l6 == b.motor.l6) && (a.motor.l8 == b.motor.l8) &&
                         (a.motor.l11 == b.motor.l11));
    }
}

/* Whatever the estimates became, the motor is one of the table. */
static void test_no_number_reads_outside_the_table(void)
{
    const float any[] = {NAN, INFINITY, -INFINITY, 3.0e38f, -3.0e38f, 1.0e-40f, 0.0f};

    for (int i = 0; i < SUPPORT_COUNT(any); i++) {
        for (int j = 0; j < SUPPORT_COUNT(any); j++) {
            const iron_tangent_t t = iron_tangent(&map, &plain, any[i], any[j]);

            TEST_ASSERT_TRUE(base_in_range(t.motor.inv_l6, 0.06f, 0.12f));
            TEST_ASSERT_TRUE(base_in_range(t.motor.inv_l8, 0.05f, 0.08f));
            TEST_ASSERT_TRUE(base_within(t.psi_q_Wb, 1.0f) && base_within(t.psi_d_Wb, 1.0f));
            TEST_ASSERT_TRUE(base_within(t.id_A, 4.001f) && base_within(t.iq_A, 4.001f));
            TEST_ASSERT_TRUE(base_within(t.motor.l5, 10.0f) && base_within(t.motor.l1, 1.0e4f));
            TEST_ASSERT_TRUE(base_in_range(t.inv_det_1pH2, 1.0f, 1.0e4f));
        }
    }
}

static void refused(float *constant, float value)
{
    const float good = *constant;

    *constant = value;
    TEST_ASSERT_FALSE(iron_check(&map));
    *constant = good;
    TEST_ASSERT_TRUE(iron_check(&map));
}

static void test_check_refuses_what_no_motor_has(void)
{
    float *positive[] = {&map.nodes_per_A_d, &map.nodes_per_A_q, &map.A_per_node_d,
                         &map.A_per_node_q,  &map.rs_Ohm,        &map.accel_per_WbA};

    TEST_ASSERT_TRUE(iron_check(&map));
    for (int k = 0; k < SUPPORT_COUNT(positive); k++) {
        refused(positive[k], 0.0f);
        refused(positive[k], -1.0f);
        for (int n = 0; n < SUPPORT_COUNT(support_not_finite); n++) {
            refused(positive[k], support_not_finite[n]);
        }
    }
    refused(&map.A_per_node_d, 1.01f * map.A_per_node_d);
    refused(&map.A_per_node_q, 1.01f * map.A_per_node_q);
    for (int i = 0; i < IRON_NODES_D; i++) {
        for (int j = 0; j < IRON_NODES_Q; j++) {
            refused(&map.node[i][j][IRON_LD], 0.0f);
            refused(&map.node[i][j][IRON_LQ], -0.1f);
            refused(&map.node[i][j][IRON_LQ], 2.0e3f);
            refused(&map.node[i][j][IRON_LDQ], 0.09f); /* no magnetic energy: D Q < M^2 */
            refused(&map.node[i][j][IRON_LDQ], -0.09f);
            for (int n = 0; n < SUPPORT_COUNT(support_not_finite); n++) {
                for (int value = 0; value < IRON_VALUES; value++) {
                    refused(&map.node[i][j][value], support_not_finite[n]);
                }
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_motor_has_the_voltages_and_the_torque_of_the_fluxes);
    RUN_TEST(test_every_node_is_itself);
    RUN_TEST(test_prediction_moves_as_the_fluxes_do);
    RUN_TEST(test_negative_q_currents_are_the_mirror_image);
    RUN_TEST(test_no_number_reads_outside_the_table);
    RUN_TEST(test_check_refuses_what_no_motor_has);
    return UNITY_END();
}
