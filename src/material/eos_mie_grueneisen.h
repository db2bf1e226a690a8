/* The Mie-Grueneisen equation of state (eos_mie_grueneisen.c) for laws of solids. Only src/material includes this. */
#ifndef MATERIAL_EOS_MIE_GRUENEISEN_H
#define MATERIAL_EOS_MIE_GRUENEISEN_H

typedef struct mie_grueneisen_par {
    double density;       /* kg/m3, rho_0 */
    double sound_speed;   /* m/s, c_0 */
    double slope;         /* s */
    double grueneisen;    /* Gamma */
    double specific_heat; /* J/kg/K */
    double temperature;   /* K, T_0 */
} mie_grueneisen_par;

typedef struct mie_grueneisen_state {
    double p;    /* Pa */
    double c2;   /* m2/s2: isentropic speed of sound, squared */
    double dpde; /* kg/m3, at constant density */
} mie_grueneisen_state;

/* The state at rho (kg/m3) and e (J/kg), without the integral of the isentrope where it is compressed; NAN beyond the end of the law. */
mie_grueneisen_state mie_grueneisen_at(const mie_grueneisen_par *par, double rho, double e);

#endif
