/* A stand-in for Fluent's udf.h, written for this test from Fluent's public documentation of its macros: just enough for carom_dpm.c and
 * harness.c. It is not Fluent, and passing here proves nothing about a release of Fluent.
 *
 * -DRP_2D=1 or 0: the solver's dimension; -DSTANDIN_OLD: macros P_... only; -DSTANDIN_SINGLE: real is float. */
#ifndef STANDIN_UDF_H
#define STANDIN_UDF_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>

#ifdef STANDIN_SINGLE
typedef float real;
#else
typedef double real;
#endif
typedef int face_t, cell_t;

#define RP_3D (!RP_2D)
#define RP_HOST 0
#define RP_NODE 1
#define ND_ND (RP_2D ? 2 : 3)
#define PATH_ACTIVE 0
#define PATH_END 1
#define PATH_ABORT 2

#define FACES 4
typedef struct thread {
    int id;
    real area[FACES][3];
    real accretion[FACES];
    struct thread *cells; /* the cells beside these faces, one to one */
    real memory[FACES][4];
    struct thread *next;
} Thread;
typedef struct {
    Thread *faces, *cells;
} Domain;
typedef struct {
    real pos[3], V[3], diam, rho, mass, time;
} state_t;
typedef struct {
    state_t state, state0;
    real flow_rate, number_in_parcel, user[4];
    int64_t part_id;
} Tracked_Particle;

extern int rp_axi, rp_axi_swirl, N_UDM_of_case;
extern Domain *domain_of_case;
void standin_error(const char *format, ...);
void standin_message(const char *format, ...);

#define N_UDM N_UDM_of_case
#define Error standin_error
#define Message0 standin_message
#define Get_Domain(id) domain_of_case
#define THREAD_ID(t) ((t)->id)
#define THREAD_T0(t) ((t)->cells)
#define F_C0(f, t) ((cell_t)(f))
#define F_AREA(A, f, t) ((A)[0] = (t)->area[f][0], (A)[1] = (t)->area[f][1], (A)[ND_ND - 1] = (t)->area[f][ND_ND - 1])
#define NV_MAG(A) sqrt((A)[0] * (A)[0] + (A)[1] * (A)[1] + (ND_ND == 3 ? (A)[ND_ND - 1] * (A)[ND_ND - 1] : 0))
#define C_UDMI(c, t, i) ((t)->memory[c][i])
#define SV_DPMS_ACCRETION accretion
#define F_STORAGE_R(f, t, sv) ((t)->sv[f])
#define thread_loop_f(t, d) for ((t) = (d)->faces; (t) != NULL; (t) = (t)->next)
#define thread_loop_c(t, d) for ((t) = (d)->cells; (t) != NULL; (t) = (t)->next)
#define begin_c_loop(c, t) for ((c) = 0; (c) < FACES; (c)++)
#define end_c_loop(c, t)
#define PRF_GISUM1(x) (x)
#define PRF_GRSUM1(x) (x)

#ifdef STANDIN_OLD
#define P_POS(p) ((p)->state.pos)
#define P_VEL(p) ((p)->state.V)
#define P_VEL0(p) ((p)->state0.V)
#define P_DIAM(p) ((p)->state.diam)
#define P_RHO(p) ((p)->state.rho)
#define P_MASS(p) ((p)->state.mass)
#define P_TIME(p) ((p)->state.time)
#define P_N(p) ((p)->number_in_parcel)
#define P_FLOW_RATE(p) ((p)->flow_rate)
#define P_USER_REAL(p, i) ((p)->user[i])
#else
#define TP_POS(tp) ((tp)->state.pos)
#define TP_VEL(tp) ((tp)->state.V)
#define TP_VEL0(tp) ((tp)->state0.V)
#define TP_DIAM(tp) ((tp)->state.diam)
#define TP_RHO(tp) ((tp)->state.rho)
#define TP_MASS(tp) ((tp)->state.mass)
#define TP_TIME(tp) ((tp)->state.time)
#define TP_N(tp) ((tp)->number_in_parcel)
#define TP_FLOW_RATE(tp) ((tp)->flow_rate)
#define TP_USER_REAL(tp, i) ((tp)->user[i])
#define TP_ID(tp) ((tp)->part_id)
#endif

#define DEFINE_EXECUTE_ON_LOADING(name, libname) void name(char *libname)
#define DEFINE_ON_DEMAND(name) void name(void)
#define DEFINE_DPM_BC(name, p, t, f, normal, dim) int name(Tracked_Particle *p, Thread *t, face_t f, real normal[], int dim)
#define DEFINE_DPM_EROSION(name, p, t, f, normal, alpha, Vmag, mdot) \
    void name(Tracked_Particle *p, Thread *t, face_t f, real normal[], real alpha, real Vmag, real mdot)
#define DEFINE_DPM_SCALAR_UPDATE(name, c, t, initialize, p) \
    void name(cell_t c, Thread *t, int initialize, Tracked_Particle *p)

#endif
