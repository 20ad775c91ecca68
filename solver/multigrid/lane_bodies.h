// The loops' bodies, compiled once for each instruction set. The including file defines
//   CLEFT_TARGET   the attribute of the machine the functions are for
// and opens a namespace of its own.

/// The entries of all lanes of an unknown.
template <class T, int lanes>
struct LanesOf {
  typedef T type __attribute__((vector_size(lanes * sizeof(T)), aligned(sizeof(T)), may_alias));
};
template <class T>
struct LanesOf<T, 1> {
  using type = T;
};

template <int lanes>
CLEFT_TARGET void residual(const BlockRows& a, const float* b, const float* x, float* r) {
  using V = typename LanesOf<float, lanes>::type;
  for (int i = 0; i < a.rows; ++i) {
    const V* own = reinterpret_cast<const V*>(b + static_cast<std::int64_t>(i) * 3 * lanes);
    V s0 = own[0], s1 = own[1], s2 = own[2];
    for (std::int64_t k = a.start[i]; k < a.start[i + 1]; ++k) {
      const V* other = reinterpret_cast<const V*>(x + static_cast<std::int64_t>(a.column[k]) * 3 * lanes);
      const float* m = a.value + 9 * k;
      const V x0 = other[0], x1 = other[1], x2 = other[2];
      s0 -= m[0] * x0 + m[1] * x1 + m[2] * x2;
      s1 -= m[3] * x0 + m[4] * x1 + m[5] * x2;
      s2 -= m[6] * x0 + m[7] * x1 + m[8] * x2;
    }
    V* out = reinterpret_cast<V*>(r + static_cast<std::int64_t>(i) * 3 * lanes);
    out[0] = s0, out[1] = s1, out[2] = s2;
  }
}

template <int lanes>
CLEFT_TARGET void relax(int nodes, const float* inverse, float keep, float step, const float* r, float* d,
                        float* x) {
  using V = typename LanesOf<float, lanes>::type;
  for (std::int64_t i = 0; i < nodes; ++i) {
    const V* in = reinterpret_cast<const V*>(r + i * 3 * lanes);
    V* move = reinterpret_cast<V*>(d + i * 3 * lanes);
    V* at = reinterpret_cast<V*>(x + i * 3 * lanes);
    const float* m = inverse + 9 * i;
    for (int a = 0; a < 3; ++a) {
      const V along = step * (m[3 * a] * in[0] + m[3 * a + 1] * in[1] + m[3 * a + 2] * in[2]);
      if (keep == 0) {
        move[a] = along, at[a] = along;
      } else {
        move[a] = keep * move[a] + along;
        at[a] += move[a];
      }
    }
  }
}

template <int lanes>
CLEFT_TARGET void restrict_to(const WeightRows& p, const float* fine, float* coarse) {
  using V = typename LanesOf<float, lanes>::type;
  for (std::int64_t i = 0; i < p.rows; ++i) {
    const V* in = reinterpret_cast<const V*>(fine + i * 3 * lanes);
    for (std::int64_t k = p.start[i]; k < p.start[i + 1]; ++k) {
      V* out = reinterpret_cast<V*>(coarse + static_cast<std::int64_t>(p.column[k]) * 3 * lanes);
      for (int a = 0; a < 3; ++a) out[a] += p.weight[k] * in[a];
    }
  }
}

template <int lanes>
CLEFT_TARGET void prolong(const WeightRows& p, const float* coarse, float* fine) {
  using V = typename LanesOf<float, lanes>::type;
  for (std::int64_t i = 0; i < p.rows; ++i) {
    V* out = reinterpret_cast<V*>(fine + i * 3 * lanes);
    for (std::int64_t k = p.start[i]; k < p.start[i + 1]; ++k) {
      const V* in = reinterpret_cast<const V*>(coarse + static_cast<std::int64_t>(p.column[k]) * 3 * lanes);
      for (int a = 0; a < 3; ++a) out[a] += p.weight[k] * in[a];
    }
  }
}

template <int lanes>
CLEFT_TARGET void multiply_node(int entries, const int* column, const double* const* rows, const double* x,
                                double* y) {
  using V = typename LanesOf<double, lanes>::type;
  V s0 = V{}, s1 = V{}, s2 = V{};
  for (int k = 0; k < entries; ++k) {
    const V in = *reinterpret_cast<const V*>(x + static_cast<std::int64_t>(column[k]) * lanes);
    s0 += rows[0][k] * in;
    s1 += rows[1][k] * in;
    s2 += rows[2][k] * in;
  }
  V* out = reinterpret_cast<V*>(y);
  out[0] = s0, out[1] = s1, out[2] = s2;
}

template <int lanes>
CLEFT_TARGET void dot(std::int64_t n, const double* a, const double* b, double* sums) {
  using V = typename LanesOf<double, lanes>::type;
  V sum = V{};
  for (std::int64_t i = 0; i < n; ++i)
    sum += *reinterpret_cast<const V*>(a + i * lanes) * *reinterpret_cast<const V*>(b + i * lanes);
  *reinterpret_cast<V*>(sums) = sum;
}

template <int lanes>
CLEFT_TARGET void dot_mixed(std::int64_t n, const float* a, const double* b, double* sums) {
  for (int c = 0; c < lanes; ++c) sums[c] = 0;
  for (std::int64_t i = 0; i < n; ++i)
    for (int c = 0; c < lanes; ++c) sums[c] += static_cast<double>(a[i * lanes + c]) * b[i * lanes + c];
}

template <int lanes>
CLEFT_TARGET void add(std::int64_t n, const double* factor, const double* x, double* y) {
  using V = typename LanesOf<double, lanes>::type;
  const V f = *reinterpret_cast<const V*>(factor);
  for (std::int64_t i = 0; i < n; ++i)
    *reinterpret_cast<V*>(y + i * lanes) += f * *reinterpret_cast<const V*>(x + i * lanes);
}

template <int lanes>
CLEFT_TARGET void follow(std::int64_t n, const double* factor, const float* z, double* p) {
  for (std::int64_t i = 0; i < n; ++i)
    for (int c = 0; c < lanes; ++c)
      p[i * lanes + c] = static_cast<double>(z[i * lanes + c]) + factor[c] * p[i * lanes + c];
}

template <int lanes>
constexpr LaneTable table = {lanes,          residual<lanes>,      relax<lanes>, restrict_to<lanes>,
                             prolong<lanes>, multiply_node<lanes>, dot<lanes>,   dot_mixed<lanes>,
                             add<lanes>,     follow<lanes>};

const LaneTable& of(int lanes) { return lanes == 1 ? table<1> : table<most_lanes>; }
