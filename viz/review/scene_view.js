'use strict';

// The scene on the screen: vtk.js draws, the camera is ours.
class SceneView {
  // Throws when the browser has no WebGL 2.
  constructor(container, scene) {
    if (!document.createElement('canvas').getContext('webgl2')) throw new Error('no WebGL 2');
    this.container = container;
    this.scene = scene;
    this.camera = new ParallelCamera();
    this.layers = new Set(scene.layers.filter((layer) => layer.shown).map((layer) => layer.key));
    this.state = scene.first_state;
    this.afterRender = () => {};
    const core = vtk.Rendering.Core;
    this.renderer = core.vtkRenderer.newInstance({background: [1, 1, 1]});
    this.window = core.vtkRenderWindow.newInstance();
    this.window.addRenderer(this.renderer);
    this.window.setNumberOfLayers(2);
    this.surface = this.window.newAPISpecificView('WebGL');
    this.surface.setContainer(container);
    this.window.addView(this.surface);
    this.renderer.getActiveCamera().setParallelProjection(true);
    this.addLights();
    this.batches = batchesOf(scene.parts).map((batch) => this.addBatch(batch));
    this.highlight = this.addHighlight();
    new ResizeObserver(() => this.resize()).observe(container);
    this.resize();
  }

  addLights() {
    this.renderer.removeAllLights();
    this.renderer.setAutomaticLightCreation(false);
    const light = vtk.Rendering.Core.vtkLight.newInstance();
    light.setLightTypeToHeadLight();
    this.renderer.addLight(light);
  }

  actorOf(data, renderer = this.renderer) {
    const mapper = vtk.Rendering.Core.vtkMapper.newInstance();
    mapper.setInputData(data);
    const actor = vtk.Rendering.Core.vtkActor.newInstance();
    actor.setMapper(mapper);
    renderer.addActor(actor);
    return actor;
  }

  addBatch(batch) {
    const data = vtk.Common.DataModel.vtkPolyData.newInstance();
    data.getPoints().setData(batch.pointArray(), 3);
    (batch.kind === 'faces' ? data.getPolys() : data.getLines()).setData(batch.cellArray());
    const bytes = new Uint8Array(3 * batch.points);
    const colors = vtk.Common.Core.vtkDataArray.newInstance(
        {name: 'colors', numberOfComponents: 3, values: bytes});
    data.getPointData().setScalars(colors);
    const actor = this.actorOf(data);
    const mapper = actor.getMapper();
    mapper.setColorModeToDirectScalars();
    mapper.setResolveCoincidentTopologyToPolygonOffset();
    const property = actor.getProperty();
    property.setLighting(batch.lit);
    property.setInterpolationToFlat();
    property.setAmbient(batch.lit ? 0.45 : 1);
    property.setDiffuse(batch.lit ? 0.6 : 0);
    property.setOpacity(batch.opacity);
    property.setLineWidth(this.widthPx(batch.width));
    return {batch, actor, bytes, colors, data};
  }

  widthPx(widthPt) { return Math.max(1, widthPt * 96 / 72 * devicePixelRatio); }

  // The selected part's lines, or else the edges of its faces, in a colour that nothing else has
  // and in a layer over everything.
  addHighlight() {
    const above = vtk.Rendering.Core.vtkRenderer.newInstance(
        {layer: 1, interactive: false, preserveColorBuffer: true});
    above.setActiveCamera(this.renderer.getActiveCamera());
    this.window.addRenderer(above);
    const data = vtk.Common.DataModel.vtkPolyData.newInstance();
    const actor = this.actorOf(data, above);
    actor.getMapper().setScalarVisibility(false);
    const property = actor.getProperty();
    property.setLighting(false);
    property.setColor(0.84, 0, 0.42);
    property.setLineWidth(this.widthPx(2.2));
    actor.setVisibility(false);
    return {data, actor};
  }

  isShown(item) {
    return this.layers.has(item.layer) && (item.state < 0 || item.state === this.state);
  }

  shownParts() { return this.scene.parts.filter((part) => this.isShown(part)); }

  select(part) {
    const {data, actor} = this.highlight;
    actor.setVisibility(part !== null && this.isShown(part));
    if (part === null) return;
    const cells = [];
    if (part.lines.length === 0)
      forEachFace(part, (face) => face.forEach((from, k) =>
          cells.push(2, from, face[(k + 1) % face.length])));
    for (let at = 0; at < part.lines.length; at += 2)
      cells.push(2, part.lines[at], part.lines[at + 1]);
    data.getPoints().setData(part.points, 3);
    data.getLines().setData(Uint32Array.from(cells));
    data.modified();
  }

  colorBy(coloring) {
    for (const {batch, bytes, colors, data} of this.batches) {
      batch.paint(bytes, coloring);
      colors.modified();
      data.modified();
    }
  }

  look(direction) {
    this.camera.look(direction.towards_viewer, direction.up);
    this.fit();
  }

  fit() {
    const parts = this.shownParts();
    this.camera.fit((parts.length > 0 ? parts : this.scene.parts).map((part) => part.points));
  }

  resize() {
    const {clientWidth, clientHeight} = this.container;
    if (clientWidth === 0 || clientHeight === 0) return;
    // What was visible stays visible when the area gets smaller.
    this.camera.mmPerPx *= Math.max(this.camera.width / clientWidth,
                                    this.camera.height / clientHeight);
    this.camera.width = clientWidth;
    this.camera.height = clientHeight;
    this.surface.setSize(Math.round(clientWidth * devicePixelRatio),
                         Math.round(clientHeight * devicePixelRatio));
    this.render();
  }

  render() {
    const {focal, towards, up, mmPerPx, height} = this.camera;
    const camera = this.renderer.getActiveCamera();
    camera.setFocalPoint(...focal);
    camera.setPosition(...combined(focal, 500, towards));
    camera.setViewUp(...up);
    camera.setParallelScale(mmPerPx * height / 2);
    for (const {batch, actor} of this.batches) actor.setVisibility(this.isShown(batch));
    this.renderer.resetCameraClippingRange();
    this.window.render();
    this.afterRender();
  }
}
