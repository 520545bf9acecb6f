/* naive.h: the sum over facets as one would first write it: what the kernel is compared with. */
#ifndef GLINT_BENCH_NAIVE_H
#define GLINT_BENCH_NAIVE_H

/* A facet in body coordinates; t, b, n unit. */
typedef struct naive_facet {
    double normal[3], tangent[3], bitangent[3];
    double area_m2;
} naive_facet;

/* Parameters of a material; lambert has rho_d alone. */
typedef struct naive_material {
    double rho_d, rho_s, alpha_x, alpha_y;
} naive_material;

/* Sum of f ci cr area over the facets for one pair of unit directions, m^2/sr. */
typedef double naive_sum(const naive_facet *facets, int n, const naive_material *m,
                         const double i[3], const double r[3]);

naive_sum naive_lambert, naive_ward, naive_ward_gmd;

#endif
