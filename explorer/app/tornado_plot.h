// The effect of each parameter on the gape: a bar from its least to its greatest value, the widest first.
#pragma once

#include <QCoreApplication>
#include <QWidget>
#include <optional>

#include "explorer/session/session.h"

namespace cleft {

class TornadoPlot : public QWidget {
  Q_DECLARE_TR_FUNCTIONS(TornadoPlot)

 public:
  explicit TornadoPlot(Session& session);
  const std::optional<Tornado>& tornado() const { return tornado_; }  ///< as drawn last, for tests

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paint_bars(QPainter& painter) const;

  Session& session_;
  std::optional<Tornado> tornado_;
  std::string study_;  // it was made of
};

}  // namespace cleft
