// Gauss' rule with 3 points and Kronrod's with 7, which contains it, on [0, 1] (A. S. Kronrod, 1965; digits as in QUADPACK's tables
// for other sizes).

#ifndef CORE_KRONROD
#define CORE_KRONROD

#define CORE_KRONROD_POINTS 7

const elvis_real core_kronrod_at[CORE_KRONROD_POINTS] =
    elvis_real[](elvis_real(0.0197543656459898582LF), elvis_real(0.112701665379258311LF), elvis_real(0.282878125326598721LF),
                 elvis_real(0.5LF), elvis_real(0.717121874673401279LF), elvis_real(0.887298334620741689LF),
                 elvis_real(0.980245634354010142LF));
const elvis_real core_kronrod_weights[CORE_KRONROD_POINTS] =
    elvis_real[](elvis_real(0.0523281130132336326LF), elvis_real(0.134244044934166720LF), elvis_real(0.200698707387981111LF),
                 elvis_real(0.225458269329237071LF), elvis_real(0.200698707387981111LF), elvis_real(0.134244044934166720LF),
                 elvis_real(0.0523281130132336326LF));
const elvis_real core_gauss_weights[CORE_KRONROD_POINTS] =
    elvis_real[](elvis_real(0), elvis_real(0.277777777777777778LF), elvis_real(0), elvis_real(0.444444444444444444LF), elvis_real(0),
                 elvis_real(0.277777777777777778LF), elvis_real(0));

#endif
