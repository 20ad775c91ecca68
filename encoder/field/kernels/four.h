// Four doubles: one wide register where the machine has it (CLEFT_WIDE), else two halves, because compilers
// divide a wide type badly. Part of bodies.h.

typedef double Two __attribute__((vector_size(16), may_alias));
typedef double LooseTwo __attribute__((vector_size(16), aligned(8), may_alias));
typedef double WideFour __attribute__((vector_size(32), may_alias));
typedef double LooseWideFour __attribute__((vector_size(32), aligned(8), may_alias));

#if CLEFT_WIDE

using Four = WideFour;
using LooseFour = LooseWideFour;

CLEFT_INLINE Four make(double a, double b, double c, double d) { return Four{a, b, c, d}; }
CLEFT_INLINE Four splat(double a) { return Four{a, a, a, a}; }
CLEFT_INLINE Four clamped(Four x, Four low, Four high) {
  x = x > low ? x : low;  // NaN becomes low
  return x < high ? x : high;
}

#else

struct LooseFour {
  LooseTwo low, high;
};

struct Four {
  Two low, high;

  Four() = default;
  CLEFT_INLINE Four(const Two& l, const Two& h) : low(l), high(h) {}
  CLEFT_INLINE Four(const LooseFour& a) : low(a.low), high(a.high) {}
  CLEFT_INLINE operator LooseFour() const { return {low, high}; }
  CLEFT_INLINE Four& operator+=(const Four& b) { return low += b.low, high += b.high, *this; }
  CLEFT_INLINE friend Four operator+(const Four& a, const Four& b) {
    return {a.low + b.low, a.high + b.high};
  }
  CLEFT_INLINE friend Four operator-(const Four& a, const Four& b) {
    return {a.low - b.low, a.high - b.high};
  }
  CLEFT_INLINE friend Four operator*(const Four& a, const Four& b) {
    return {a.low * b.low, a.high * b.high};
  }
  CLEFT_INLINE friend Four operator/(const Four& a, const Four& b) {
    return {a.low / b.low, a.high / b.high};
  }
  CLEFT_INLINE friend Four operator*(double a, const Four& b) { return {a * b.low, a * b.high}; }
  CLEFT_INLINE friend Four operator*(const Four& a, double b) { return b * a; }
  CLEFT_INLINE friend Four operator/(double a, const Four& b) { return {a / b.low, a / b.high}; }
  CLEFT_INLINE friend Four operator-(double a, const Four& b) { return {a - b.low, a - b.high}; }
  CLEFT_INLINE friend Four operator-(const Four& a) { return {-a.low, -a.high}; }
};

CLEFT_INLINE Four make(double a, double b, double c, double d) { return {Two{a, b}, Two{c, d}}; }
CLEFT_INLINE Four splat(double a) { return {Two{a, a}, Two{a, a}}; }
CLEFT_INLINE Two clamped(Two x, const Two& low, const Two& high) {
  x = x > low ? x : low;
  return x < high ? x : high;
}
CLEFT_INLINE Four clamped(const Four& x, const Four& low, const Four& high) {
  return {clamped(x.low, low.low, high.low), clamped(x.high, low.high, high.high)};
}

#endif

CLEFT_INLINE const Four& four(const double* p) { return *reinterpret_cast<const Four*>(p); }
CLEFT_INLINE Four& four(double* p) { return *reinterpret_cast<Four*>(p); }
/// The same where memory is not aligned.
CLEFT_INLINE Four loose(const double* p) { return *reinterpret_cast<const LooseFour*>(p); }
CLEFT_INLINE void put(double* p, const Four& a) { *reinterpret_cast<LooseFour*>(p) = a; }
