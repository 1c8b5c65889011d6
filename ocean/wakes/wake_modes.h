// The waves of a wake's window, one Fourier mode at a time.
//
// Linear waves on water of one depth. With a = (eta + i (omega / g) phi) / 2 for the heights' and
// the potential's amplitudes, a source q of water at the surface gives a' = -i omega a + q / 2, so
// that a(t) = integral of q(t - s) exp(-i omega s) / 2 over ages s. That integral is known in
// closed form for a hump that falls at one moment and for a source that moves straight on:
// there is no step in time. A mode's waves travel at its group velocity; from half of the age on at
// which they leave the window they fade, so that nothing comes round in what is periodic.
#pragma once

#include <cstdint>

#include "ocean/spectrum/fft.h"
#include "ocean/wakes/wake_sources.h"

namespace swell::ocean {

enum class WakeField : std::uint8_t { kHeight, kRise, kDriftX, kDriftY };

// Writes columns [column0, column0 + 16) of the field's modes as a batch for inverse_fft_2d(), of
// which the real part is the field: heights in m, or velocities of the water at the surface in m/s
// (up, east, north). The plan is of kWakeSamples. Returns false, with nothing written, if there are
// none.
bool fill_wake(const WakeWindow& window, WakeField field, const FftPlan& plan, int column0,
               float* re, float* im);

}  // namespace swell::ocean
