#include "host/reproduce/compensation_range.hpp"
#include "host/reproduce/linear_motor.hpp"
#include "host/reproduce/relay_examples.hpp"
#include "host/reproduce/sinefit_examples.hpp"

namespace cartwright::reproduce {

Paper relay_paper() {
  return {"relay",
          "Sine fitting and dual-relay friction identification (Dou, Chen; Tan, Lee and others)",
          {{"record", "memo 3.1: sine fit to a relay record", relay_record_example},
           {"noise", "memo 3.3: sine fit in noise, side lobes", noise_examples},
           {"relay", "memo 3.2 and paper Section 4: friction from relay tests", relay_identification},
           {"adaptive", "paper Section 5: three starts of the adaptive law, Figs. 8-10", adaptive_starts},
           {"motor", "paper Section 6: friction compensation on the linear motor", linear_motor},
           {"compensation", "what encoder, noise and time do to the compensation", compensation_range}}};
}

}  // namespace cartwright::reproduce
