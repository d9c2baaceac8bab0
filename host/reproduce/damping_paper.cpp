#include "host/reproduce/designed_responses.hpp"
#include "host/reproduce/identification.hpp"
#include "host/reproduce/least_kd.hpp"
#include "host/reproduce/table_1.hpp"
#include "host/reproduce/table_2.hpp"
#include "host/reproduce/table_3.hpp"
#include "host/reproduce/theorem_1.hpp"

namespace cartwright::reproduce {

Paper damping_paper() {
  return {"damping",
          "Minimal modelling of non-linear damping (Wongvanich, Hann, Sirisena 2015)",
          {{"theorem1", "Theorem 1, Corollary 2: damping from 5 to 400 intervals", damping_identifiability},
           {"identification", "Eq. 64, 73, 75-78 from simulated carts", identified_carts},
           {"table1", "voltages of the eight responses", voltage_ranges},
           {"table2", "prediction errors of six models for eight pairs of gains", prediction_errors},
           {"design", "Section 4.4: least Kd, mean squared voltage", least_derivative_gain},
           {"fig19", "Fig. 19: predicted responses", predicted_responses},
           {"fig20", "Fig. 20: a controller designed on the non-linear model", designed_response},
           {"table3", "Table 3: the integral method against non-linear regression", against_regression}}};
}

}  // namespace cartwright::reproduce
