// SPDX-License-Identifier: MIT
/// The weights of a drive that a search moves, and the point of the search that they are.
#pragma once

#include <vector>

#include "drive/drive_file.hpp"
#include "tune/tune_spec.hpp"

namespace sdre {

/// The logarithms, base 10, of searched_weights() in the units of with_weights().
using Point = std::vector<double>;

/// One weight that a search moves, where two axes have the same: both.
struct SearchedWeight {
    bool                  controller; ///< else the observer's
    std::vector<double *> values;     ///< in the drive
};

/// Controller: speed error and q-axis error. Observer: drift of the load, drift of both voltages, noise of speed and currents.
/// noc_shaft has four more: speed of the load and twist, first the controller's and then the observer's. The drive is near optimal
/// and in its encoder form.
std::vector<SearchedWeight> searched_weights(Drive &drive);

/// Standard deviations of one sample.
struct Sensors {
    double current_A; ///< noise and quantisation
    double angle_rad; ///< quantisation, or what the edges are off
};

Sensors sensors_of(const Drive &drive, const TuneSpec &spec);

/// The number that three digits on paper say: weights are searched, judged and written as that.
double written(double weight);

/// A drive's own weights, all positive.
Point point_of(Drive drive);

/// The drive with the weights of a point, each as written().
Drive with_weights(Drive drive, const TuneSpec &spec, const Point &x);

} // namespace sdre
