// SPDX-License-Identifier: MIT
/// A client that sends set-points of a sine at a constant rate, and compares the shaft with it.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "running_client.hpp"

namespace sdre {

class CyclicClient : public RunningClient {
protected:
    struct Period {
        double time_s;
        double value; ///< of the shaft
    };

    /// @param settled_s From there on the shaft is compared with the sine.
    CyclicClient(double (*sine)(double time_s), double settled_s)
        : sine_(sine), settled_s_(settled_s)
    {
    }
    void begin(int mode_of_operation, int period_ms)
    {
        ASSERT_TRUE(write_one(APP_REGISTERS_INTERPOLATION_PERIOD, period_ms));
        enable(mode_of_operation);
        begin_time();
    }
    void begin_time()
    {
        zero_s = served.time_s();
        all.clear();
    }
    void note(double value)
    {
        all.push_back({served.time_s() - zero_s, value});
    }
    /// Set-points at multiples of the period, each late or early by some of it. Every lost_each-th is lost.
    template <typename Write>
    void send_each(double period_s, double jitter, int lost_each, double length_s,
                   const Write &write_point)
    {
        std::mt19937                           random(1);
        std::uniform_real_distribution<double> off(-jitter, jitter);
        for (int k = 1; k * period_s < length_s; k++) {
            const double at_s = zero_s + (k + off(random)) * period_s;
            pass(std::max(at_s - served.time_s(), 0.0));
            if (lost_each == 0 || k % lost_each != 0) {
                ASSERT_TRUE(write_point(k * period_s));
            }
        }
    }
    /// How far the shaft is from the sine that is so much later.
    double rms(double delay_s) const
    {
        double sum = 0.0;
        int    n   = 0;
        for (const Period &p : all) {
            if (p.time_s > settled_s_) {
                sum += std::pow(p.value - sine_(p.time_s - delay_s), 2);
                n++;
            }
        }
        return std::sqrt(sum / n);
    }
    double farthest(double delay_s) const
    {
        double most = 0.0;
        for (const Period &p : all) {
            if (p.time_s > settled_s_) {
                most = std::max(most, std::abs(p.value - sine_(p.time_s - delay_s)));
            }
        }
        return most;
    }

    double              zero_s = 0.0;
    std::vector<Period> all;

private:
    double (*sine_)(double time_s);
    double settled_s_;
};

} // namespace sdre
