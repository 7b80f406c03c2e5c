// SPDX-License-Identifier: MIT
/// How many terms the two series need: every order against the exact point-wise solution of the SDRE.
#pragma once

#include <string>
#include <vector>

#include "drive/drive_file.hpp"

namespace sdre {

/// One of the two series. errors[order][i]: largest relative gain error while every scheduling current is within
/// +-within_A[i].
struct LoopOrders {
    std::string                      name;     ///< "controller" or "observer"
    std::string                      variable; ///< "e_iq" and so on
    std::vector<int>                 lyapunov; ///< equations solved up to that order
    std::vector<double>              within_A; ///< rising, to twice the current limit
    std::vector<std::vector<double>> errors;
};

struct OrderStudy {
    std::string             drive;
    double                  max_current_A = 0.0;
    std::vector<LoopOrders> loops; ///< controller, observer
};

/// Orders 0 .. highest of both series, instead of the drive file's. InputError when the law has no series.
OrderStudy study_orders(Drive drive, int highest);

/// At quarters of the current limit up to twice that.
std::string orders_text(const OrderStudy &study);
/// Every grid point: loop,order,within_A,error.
std::string orders_csv(const OrderStudy &study);
std::string orders_json(const OrderStudy &study);

} // namespace sdre
